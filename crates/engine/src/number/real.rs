//! The floats that a simulation runs in, and their SIMD lanes.

use faer::traits::RealField as FaerReal;
use nalgebra::RealField;
use simba::simd::{SimdRealField, SimdValue, WideF32x8, WideF64x4};

use super::Packed;

/// The type that a kernel computes with: one [`Real`], or lanes of them.
pub trait Number: SimdRealField + SimdValue<Element: Real> + Copy {}

impl<T: SimdRealField + SimdValue<Element: Real> + Copy> Number for T {}

/// The float that a whole simulation runs in.
pub trait Real: RealField + FaerReal + Packed + Default + std::iter::Sum {
    /// As many of them as a register of 256 bits holds.
    type Lanes: Number<Element = Self>;
    /// Number of lanes in [`Lanes`](Self::Lanes).
    const WIDTH: usize;
    /// Number of lanes in the widest register of any processor, to which dense columns are padded.
    const MAX_WIDTH: usize;
    /// Relative distance from 1 to the next number.
    const EPSILON: Self;

    /// Lanes with the value of each lane number.
    fn lanes(value: impl FnMut(usize) -> Self) -> Self::Lanes;

    /// The numbers of all lanes.
    fn each(lanes: &Self::Lanes) -> &[Self];

    /// The numbers of all lanes, mutable.
    fn each_mut(lanes: &mut Self::Lanes) -> &mut [Self];

    /// Adds each lane of a block to the block `target(lane)`, unless that is out of range. Lanes are transposed in registers,
    /// not number by number: extracting numbers from lanes takes much of the time of an assembly.
    fn add_by_lane(lanes: &[[Self::Lanes; 3]; 3], blocks: &mut [[[Self; 3]; 3]], target: impl Fn(usize) -> u32);

    /// The nearest number of this type.
    fn of(x: f64) -> Self;

    /// The same number, exactly.
    fn as_f64(self) -> f64;

    /// x^(−1/3) to a few percent, for normal x > 0: divides the exponent by three in the binary representation.
    fn rough_inverse_cube_root(self) -> Self;

    /// The integer k for which x/2^k lies in [√½, √2), for normal x > 0.
    fn binary_exponent(self) -> Self;

    /// x/2^k in [√½, √2), with k the [`binary_exponent`](Self::binary_exponent).
    fn significand(self) -> Self;
}

/// Implements [`Real`] for a float with its lanes, their number and [`Real::MAX_WIDTH`]; the conversions and the functions that
/// work on binary representations are given by the last argument.
macro_rules! real {
    ($float:ident, $lanes:ident, $wide:ty, $width:literal, $max_width:literal, { $($conversions:tt)* }) => {
        impl Real for $float {
            type Lanes = $lanes;
            const WIDTH: usize = $width;
            const MAX_WIDTH: usize = $max_width;
            const EPSILON: Self = $float::EPSILON;

            #[inline(always)]
            fn lanes(value: impl FnMut(usize) -> $float) -> Self::Lanes {
                $lanes(<$wide>::new(std::array::from_fn(value)))
            }

            #[inline(always)]
            fn each(lanes: &Self::Lanes) -> &[$float] {
                lanes.0.as_array()
            }

            #[inline(always)]
            fn each_mut(lanes: &mut Self::Lanes) -> &mut [$float] {
                lanes.0.as_mut_array()
            }

            #[inline(always)]
            fn add_by_lane(
                lanes: &[[Self::Lanes; 3]; 3],
                blocks: &mut [[[$float; 3]; 3]],
                target: impl Fn(usize) -> u32,
            ) {
                let (full, rest) = lanes.as_flattened().as_chunks::<$width>();
                let mut rows = [[<$wide>::ZERO; $width]; 2];
                for (rows, lanes) in rows.iter_mut().zip(full) {
                    *rows = <$wide>::transpose(lanes.map(|lanes| lanes.0));
                }
                for lane in 0..$width {
                    let Some(block) = blocks.get_mut(target(lane) as usize) else { continue };
                    let (sums, last) = block.as_flattened_mut().as_chunks_mut::<$width>();
                    for (sums, rows) in sums.iter_mut().zip(&rows) {
                        *sums = (<$wide>::new(*sums) + rows[lane]).to_array();
                    }
                    for (sum, lanes) in last.iter_mut().zip(rest) {
                        *sum += lanes.0.as_array()[lane];
                    }
                }
            }

            $($conversions)*
        }
    };
}

real!(f64, WideF64x4, wide::f64x4, 4, 8, {
    #[inline(always)]
    fn of(x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn as_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn rough_inverse_cube_root(self) -> f64 {
        // Exponents beyond those of f32 saturate, and Newton's iteration would then need more than its four steps. No element
        // is compressed or stretched by 1e38.
        f64::from((self as f32).rough_inverse_cube_root())
    }

    #[inline(always)]
    fn binary_exponent(self) -> f64 {
        let beyond = self.to_bits().wrapping_sub(std::f64::consts::FRAC_1_SQRT_2.to_bits()) as i64;
        f64::from((beyond >> 52) as i32)
    }

    #[inline(always)]
    fn significand(self) -> f64 {
        let beyond = self.to_bits().wrapping_sub(std::f64::consts::FRAC_1_SQRT_2.to_bits());
        f64::from_bits(self.to_bits().wrapping_sub(beyond & 0xfff0_0000_0000_0000))
    }
});

real!(f32, WideF32x8, wide::f32x8, 8, 16, {
    #[inline(always)]
    fn of(x: f64) -> f32 {
        x as f32
    }

    #[inline(always)]
    fn as_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn rough_inverse_cube_root(self) -> f32 {
        f32::from_bits(0x54a2_fa8cu32.wrapping_sub(self.to_bits() / 3))
    }

    #[inline(always)]
    fn binary_exponent(self) -> f32 {
        let beyond = self.to_bits().wrapping_sub(std::f32::consts::FRAC_1_SQRT_2.to_bits()) as i32;
        (beyond >> 23) as f32
    }

    #[inline(always)]
    fn significand(self) -> f32 {
        let beyond = self.to_bits().wrapping_sub(std::f32::consts::FRAC_1_SQRT_2.to_bits());
        f32::from_bits(self.to_bits().wrapping_sub(beyond & 0xff80_0000))
    }
});
