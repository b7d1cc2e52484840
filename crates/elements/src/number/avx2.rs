//! Lanes in registers of 256 bits, for processors with AVX2.
//!
//! A value carries pulp's proof that the processor has the instructions; the proof takes no room. Operations are single instructions
//! inside [`Number::vectorize`], and calls outside.

mod bits;

use std::arch::x86_64::{__m256, __m256d};
use std::ops::{Add, AddAssign, BitAnd, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use std::sync::OnceLock;

use pulp::bytemuck::{cast, cast_mut, cast_ref};
use pulp::x86::V3;
use pulp::{Simd, WithSimd};

use super::arithmetic::{Lanes, Number};
use super::instructions::{Instructions, avx2, instructions};
use super::lanes::{F32x8, F64x4};

/// The proof of AVX2, once [`is_available`] has found it.
static PROOF: OnceLock<V3> = OnceLock::new();

/// The proof of AVX2. Detection has no place here: a call that returns would force the registers of the kernel around it into memory.
#[inline(always)]
fn proof() -> V3 {
    match PROOF.get() {
        Some(simd) => *simd,
        None => unproven(),
    }
}

#[cold]
#[inline(never)]
fn unproven() -> ! {
    panic!("these lanes are for processors with AVX2: ask `Float::has_fast` first")
}

/// Returns true if kernels are run with AVX2.
pub(super) fn is_available() -> bool {
    let simd = avx2();
    if let Some(simd) = simd {
        PROOF.get_or_init(|| simd);
    }
    simd.is_some()
}

/// Defines lanes of a float in a register, with the instructions that work on them.
macro_rules! avx2_lanes {
    ($(#[$doc:meta])* $Lanes:ident, $Mask:ident, $float:ident, $Stored:ident, $Register:ident, $width:literal, $all:literal;
     $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $max:ident, $min:ident, $and:ident, $andnot:ident, $or:ident, $xor:ident,
     $compare:ident, $fma:ident, $blend:ident, $movemask:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $Lanes {
            register: $Register,
            simd: V3,
        }

        /// A truth value in each lane, all bits of it.
        #[derive(Clone, Copy, Debug)]
        pub struct $Mask($Lanes);

        impl BitAnd for $Mask {
            type Output = Self;

            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                Self(self.0.with(self.0.simd.avx.$and(self.0.register, other.0.register)))
            }
        }

        impl $Lanes {
            #[inline(always)]
            fn with(self, register: $Register) -> Self {
                Self { register, ..self }
            }

            /// −0 in every lane: the sign alone.
            #[inline(always)]
            fn sign(self) -> $Register {
                cast([-0.0 as $float; $width])
            }
        }

        impl Number for $Lanes {
            type Element = $float;
            type Mask = $Mask;
            const LANES: usize = $width;

            #[inline(always)]
            fn vectorize<W: WithSimd>(work: W) -> W::Output {
                Simd::vectorize(proof(), work)
            }

            #[inline(always)]
            fn vectorize_widest<W: WithSimd>(work: W) -> W::Output {
                match instructions() {
                    Instructions::Avx512(simd) => Simd::vectorize(simd, work),
                    _ => Simd::vectorize(proof(), work),
                }
            }

            #[inline(always)]
            fn splat(x: $float) -> Self {
                Self { register: cast([x; $width]), simd: proof() }
            }

            #[inline(always)]
            fn lane(&self, lane: usize) -> $float {
                self.as_slice()[lane]
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, x: $float) {
                self.as_mut_slice()[lane] = x;
            }

            #[inline(always)]
            fn map_lanes(self, value: impl Fn($float) -> $float) -> Self {
                let mut numbers: [$float; $width] = cast(self.register);
                for number in &mut numbers {
                    *number = value(*number);
                }
                self.with(cast(numbers))
            }

            #[inline(always)]
            fn rough_inverse_cube_root(self) -> Self {
                let rough = self.rough_bits();
                self.with(rough)
            }

            #[inline(always)]
            fn exponent_and_significand(self) -> (Self, Self) {
                let (exponent, significand) = self.parts();
                (self.with(exponent), self.with(significand))
            }

            #[inline(always)]
            fn select(self, mask: $Mask, other: Self) -> Self {
                self.with(self.simd.avx.$blend(other.register, self.register, mask.0.register))
            }

            #[inline(always)]
            fn times_plus(self, y: Self, z: Self) -> Self {
                self.with(self.simd.fma.$fma(self.register, y.register, z.register))
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                self.with(self.simd.avx.$sqrt(self.register))
            }

            #[inline(always)]
            fn abs(self) -> Self {
                self.with(self.simd.avx.$andnot(self.sign(), self.register))
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                let sign = self.simd.avx.$and(self.sign(), sign.register);
                self.with(self.simd.avx.$or(self.abs().register, sign))
            }

            #[inline(always)]
            fn gt(self, other: Self) -> $Mask {
                $Mask(self.with(self.simd.avx.$compare::<GREATER>(self.register, other.register)))
            }

            #[inline(always)]
            fn ge(self, other: Self) -> $Mask {
                $Mask(self.with(self.simd.avx.$compare::<GREATER_OR_EQUAL>(self.register, other.register)))
            }

            #[inline(always)]
            fn eq(self, other: Self) -> $Mask {
                $Mask(self.with(self.simd.avx.$compare::<EQUAL>(self.register, other.register)))
            }

            #[inline(always)]
            fn all(mask: $Mask) -> bool {
                mask.0.simd.avx.$movemask(mask.0.register) == $all
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.with(self.simd.avx.$max(self.register, other.register))
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                self.with(self.simd.avx.$min(self.register, other.register))
            }
        }

        impl Lanes for $Lanes {
            #[inline(always)]
            fn load(self, stored: &$Stored, _part: usize) -> Self {
                self.with(stored.0)
            }

            #[inline(always)]
            fn store(self, stored: &mut $Stored, _part: usize) {
                stored.0 = self.register;
            }

            #[inline(always)]
            fn as_slice(&self) -> &[$float] {
                cast_ref::<$Register, [$float; $width]>(&self.register)
            }

            #[inline(always)]
            fn as_mut_slice(&mut self) -> &mut [$float] {
                cast_mut::<$Register, [$float; $width]>(&mut self.register)
            }

            #[inline(always)]
            fn gather(self, vectors: &[[$float; 3]], node: impl Fn(usize) -> u32) -> [Self; 3] {
                self.gather_rows(vectors, node)
            }

            #[inline(always)]
            fn add_vectors_by_lane(lanes: &[Self; 3], sums: &mut [[$float; 3]], target: impl Fn(usize) -> u32) {
                Self::add_rows(lanes, sums, target);
            }

            #[inline(always)]
            fn add_by_lane(lanes: &[[Self; 3]; 3], blocks: &mut [[[$float; 3]; 3]], target: impl Fn(usize) -> u32) {
                let (full, rest) = lanes.as_flattened().as_chunks::<$width>();
                let mut rows = [[lanes[0][0]; $width]; 2];
                for (rows, lanes) in rows.iter_mut().zip(full) {
                    *rows = Self::transpose(*lanes);
                }
                for lane in 0..$width {
                    let Some(block) = blocks.get_mut(target(lane) as usize) else { continue };
                    let (sums, last) = block.as_flattened_mut().as_chunks_mut::<$width>();
                    for (sums, rows) in sums.iter_mut().zip(&rows) {
                        let row = rows[lane];
                        *sums = cast(row.simd.avx.$add(cast(*sums), row.register));
                    }
                    for (sum, lanes) in last.iter_mut().zip(rest) {
                        *sum += lanes.as_slice()[lane];
                    }
                }
            }
        }

        operators!($Lanes, Add::add $add, AddAssign::add_assign);
        operators!($Lanes, Sub::sub $sub, SubAssign::sub_assign);
        operators!($Lanes, Mul::mul $mul, MulAssign::mul_assign);
        operators!($Lanes, Div::div $div, DivAssign::div_assign);

        impl Neg for $Lanes {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                self.with(self.simd.avx.$xor(self.sign(), self.register))
            }
        }
    };
}

macro_rules! operators {
    ($Lanes:ident, $Operator:ident::$operate:ident $instruction:ident, $Assign:ident::$assign:ident) => {
        impl $Operator for $Lanes {
            type Output = Self;

            #[inline(always)]
            fn $operate(self, other: Self) -> Self {
                self.with(self.simd.avx.$instruction(self.register, other.register))
            }
        }

        impl $Assign for $Lanes {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                self.register = self.simd.avx.$instruction(self.register, other.register);
            }
        }
    };
}

/// Comparisons that are false for NaN and raise nothing, as `_mm256_cmp_pd` numbers them.
const EQUAL: i32 = 0;
const GREATER_OR_EQUAL: i32 = 29;
const GREATER: i32 = 30;

avx2_lanes!(
    /// Four double-precision lanes.
    Avx2F64x4, MaskF64x4, f64, F64x4, __m256d, 4, 0b1111;
    _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_sqrt_pd, _mm256_max_pd, _mm256_min_pd, _mm256_and_pd,
    _mm256_andnot_pd, _mm256_or_pd, _mm256_xor_pd, _mm256_cmp_pd, _mm256_fmadd_pd, _mm256_blendv_pd, _mm256_movemask_pd
);
avx2_lanes!(
    /// Eight single-precision lanes.
    Avx2F32x8, MaskF32x8, f32, F32x8, __m256, 8, 0b1111_1111;
    _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps, _mm256_sqrt_ps, _mm256_max_ps, _mm256_min_ps, _mm256_and_ps,
    _mm256_andnot_ps, _mm256_or_ps, _mm256_xor_ps, _mm256_cmp_ps, _mm256_fmadd_ps, _mm256_blendv_ps, _mm256_movemask_ps
);
