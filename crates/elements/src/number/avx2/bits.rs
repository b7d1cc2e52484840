//! Binary representations and transposes in registers.

use std::arch::x86_64::{__m256, __m256d, __m256i};

use pulp::bytemuck::cast;

use super::super::arithmetic::{CUBE_ROOT_F32, CUBE_ROOT_F64, THIRD};
use super::{Avx2F32x8, Avx2F64x4};

impl Avx2F64x4 {
    /// A constant minus a third of the bits.
    #[inline(always)]
    pub(super) fn rough_bits(self) -> __m256d {
        let avx2 = self.simd.avx2;
        let high = avx2._mm256_srli_epi64::<32>(cast(self.register));
        let third = avx2._mm256_mul_epu32(high, cast([THIRD; 4]));
        cast(avx2._mm256_sub_epi64(cast([CUBE_ROOT_F64; 4]), third))
    }

    /// The exponent k and x/2^k in [√½, √2): the bits beyond those of √½ begin with the exponent.
    #[inline(always)]
    pub(super) fn parts(self) -> (__m256d, __m256d) {
        let (avx, avx2) = (self.simd.avx, self.simd.avx2);
        let bits: __m256i = cast(self.register);
        let beyond = avx2._mm256_sub_epi64(bits, cast([std::f64::consts::FRAC_1_SQRT_2.to_bits(); 4]));
        let whole = avx2._mm256_and_si256(beyond, cast([0xfff0_0000_0000_0000u64; 4]));
        let high =
            avx2._mm256_permutevar8x32_epi32(avx2._mm256_srai_epi32::<20>(beyond), cast([1i32, 3, 5, 7, 1, 3, 5, 7]));
        let exponent = avx._mm256_cvtepi32_pd(avx._mm256_castsi256_si128(high));
        (exponent, cast(avx2._mm256_sub_epi64(bits, whole)))
    }

    /// The vector of a node in each lane. Vectors are loaded with the number behind them and transposed in registers.
    #[inline(always)]
    pub(super) fn gather_rows(self, vectors: &[[f64; 3]], node: impl Fn(usize) -> u32) -> [Self; 3] {
        let numbers = vectors.as_flattened();
        let mut rows = [self; 4];
        for lane in 0..4 {
            let node = node(lane) as usize;
            rows[lane].register = match numbers.get(3 * node..3 * node + 4) {
                Some(&[x, y, z, behind]) => cast([x, y, z, behind]),
                _ => {
                    let [x, y, z] = vectors[node];
                    cast([x, y, z, 0.0])
                }
            };
        }
        let [x, y, z, _] = Self::transpose(rows);
        [x, y, z]
    }

    /// Adds the vector in each lane to that of a node, unless it is out of range.
    #[inline(always)]
    pub(super) fn add_rows(lanes: &[Self; 3], sums: &mut [[f64; 3]], target: impl Fn(usize) -> u32) {
        let [x, y, z] = *lanes;
        let simd = x.simd;
        let rows = Self::transpose([x, y, z, z]);
        for lane in 0..4 {
            let Some([x, y, z]) = sums.get_mut(target(lane) as usize) else { continue };
            let row = rows[lane].register;
            let plane = simd.sse2._mm_add_pd(cast([*x, *y]), simd.avx._mm256_castpd256_pd128(row));
            [*x, *y] = cast(plane);
            *z += cast::<__m256d, [f64; 4]>(row)[2];
        }
    }

    /// The transpose of four rows.
    #[inline(always)]
    pub(super) fn transpose(rows: [Self; 4]) -> [Self; 4] {
        let avx = rows[0].simd.avx;
        let [a, b, c, d] = [rows[0].register, rows[1].register, rows[2].register, rows[3].register];
        let (ab, cd) = (avx._mm256_unpacklo_pd(a, b), avx._mm256_unpacklo_pd(c, d));
        let (high_ab, high_cd) = (avx._mm256_unpackhi_pd(a, b), avx._mm256_unpackhi_pd(c, d));
        [
            rows[0].with(avx._mm256_permute2f128_pd::<0x20>(ab, cd)),
            rows[0].with(avx._mm256_permute2f128_pd::<0x20>(high_ab, high_cd)),
            rows[0].with(avx._mm256_permute2f128_pd::<0x31>(ab, cd)),
            rows[0].with(avx._mm256_permute2f128_pd::<0x31>(high_ab, high_cd)),
        ]
    }
}

impl Avx2F32x8 {
    /// A constant minus a third of the bits.
    #[inline(always)]
    pub(super) fn rough_bits(self) -> __m256 {
        let avx2 = self.simd.avx2;
        let bits: __m256i = cast(self.register);
        let third = avx2._mm256_add_epi32(avx2._mm256_srli_epi32::<2>(bits), avx2._mm256_srli_epi32::<4>(bits));
        let third = avx2._mm256_add_epi32(third, avx2._mm256_srli_epi32::<4>(third));
        let third = avx2._mm256_add_epi32(third, avx2._mm256_srli_epi32::<8>(third));
        cast(avx2._mm256_sub_epi32(cast([CUBE_ROOT_F32; 8]), third))
    }

    /// The exponent k and x/2^k in [√½, √2): the bits beyond those of √½ begin with the exponent.
    #[inline(always)]
    pub(super) fn parts(self) -> (__m256, __m256) {
        let (avx, avx2) = (self.simd.avx, self.simd.avx2);
        let bits: __m256i = cast(self.register);
        let beyond = avx2._mm256_sub_epi32(bits, cast([std::f32::consts::FRAC_1_SQRT_2.to_bits(); 8]));
        let whole = avx2._mm256_and_si256(beyond, cast([0xff80_0000u32; 8]));
        (avx._mm256_cvtepi32_ps(avx2._mm256_srai_epi32::<23>(beyond)), cast(avx2._mm256_sub_epi32(bits, whole)))
    }

    /// The vector of a node in each lane.
    #[inline(always)]
    pub(super) fn gather_rows(self, vectors: &[[f32; 3]], node: impl Fn(usize) -> u32) -> [Self; 3] {
        let mut lanes = [[0.0; 8]; 3];
        for lane in 0..8 {
            let vector = vectors[node(lane) as usize];
            for i in 0..3 {
                lanes[i][lane] = vector[i];
            }
        }
        lanes.map(
            #[inline(always)]
            |numbers| self.with(cast(numbers)),
        )
    }

    /// Adds the vector in each lane to that of a node, unless it is out of range.
    #[inline(always)]
    pub(super) fn add_rows(lanes: &[Self; 3], sums: &mut [[f32; 3]], target: impl Fn(usize) -> u32) {
        let [x, y, z] = lanes.map(
            #[inline(always)]
            |lanes| cast::<__m256, [f32; 8]>(lanes.register),
        );
        for lane in 0..8 {
            let Some(sum) = sums.get_mut(target(lane) as usize) else { continue };
            sum[0] += x[lane];
            sum[1] += y[lane];
            sum[2] += z[lane];
        }
    }

    /// The transpose of eight rows: pairs within each half of a register, then fours, then the halves.
    #[inline(always)]
    pub(super) fn transpose(rows: [Self; 8]) -> [Self; 8] {
        let avx = rows[0].simd.avx;
        let mut upper = [rows[0].register; 4];
        let mut lower = upper;
        for (half, first) in [(&mut upper, 0), (&mut lower, 4)] {
            let [a, b, c, d] = [rows[first], rows[first + 1], rows[first + 2], rows[first + 3]];
            let (ab, cd) =
                (avx._mm256_unpacklo_ps(a.register, b.register), avx._mm256_unpacklo_ps(c.register, d.register));
            let (high_ab, high_cd) =
                (avx._mm256_unpackhi_ps(a.register, b.register), avx._mm256_unpackhi_ps(c.register, d.register));
            *half = [
                avx._mm256_shuffle_ps::<0x44>(ab, cd),
                avx._mm256_shuffle_ps::<0xEE>(ab, cd),
                avx._mm256_shuffle_ps::<0x44>(high_ab, high_cd),
                avx._mm256_shuffle_ps::<0xEE>(high_ab, high_cd),
            ];
        }
        let mut columns = rows;
        for i in 0..4 {
            columns[i].register = avx._mm256_permute2f128_ps::<0x20>(upper[i], lower[i]);
            columns[i + 4].register = avx._mm256_permute2f128_ps::<0x31>(upper[i], lower[i]);
        }
        columns
    }
}
