//! `f64` and `f32` as numbers of kernels and of simulations.

use super::arithmetic::{CUBE_ROOT_F32, CUBE_ROOT_F64, Float, Lanes, Number, THIRD};
#[cfg(target_arch = "x86_64")]
use super::avx2::{Avx2F32x8 as FastF32, Avx2F64x4 as FastF64, is_available as has_fast};
use super::lanes::{F32x8, F64x4};
#[cfg(not(target_arch = "x86_64"))]
use super::lanes::{F32x8 as FastF32, F64x4 as FastF64};

/// Other processors have one kind of lanes.
#[cfg(not(target_arch = "x86_64"))]
fn has_fast() -> bool {
    true
}

/// Implements [`Number`] for a float.
macro_rules! number {
    ($float:ident) => {
        impl Number for $float {
            type Element = Self;
            type Mask = bool;
            const LANES: usize = 1;

            #[inline(always)]
            fn splat(x: Self) -> Self {
                x
            }

            #[inline(always)]
            fn rough_inverse_cube_root(self) -> Self {
                Float::rough_inverse_cube_root(self)
            }

            #[inline(always)]
            fn lane(&self, _lane: usize) -> Self {
                *self
            }

            #[inline(always)]
            fn set_lane(&mut self, _lane: usize, x: Self) {
                *self = x;
            }

            #[inline(always)]
            fn map_lanes(self, value: impl Fn(Self) -> Self) -> Self {
                value(self)
            }

            #[inline(always)]
            fn select(self, mask: bool, other: Self) -> Self {
                if mask { self } else { other }
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $float::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                $float::copysign(self, sign)
            }

            #[inline(always)]
            fn gt(self, other: Self) -> bool {
                self > other
            }

            #[inline(always)]
            fn ge(self, other: Self) -> bool {
                self >= other
            }

            #[inline(always)]
            fn eq(self, other: Self) -> bool {
                self == other
            }

            #[inline(always)]
            fn all(mask: bool) -> bool {
                mask
            }
        }

        impl Lanes for $float {
            #[inline(always)]
            fn load(self, stored: &<Self as Float>::Lanes, part: usize) -> Self {
                stored.as_slice()[part]
            }

            #[inline(always)]
            fn store(self, stored: &mut <Self as Float>::Lanes, part: usize) {
                stored.as_mut_slice()[part] = self;
            }

            #[inline(always)]
            fn as_slice(&self) -> &[Self] {
                std::slice::from_ref(self)
            }

            #[inline(always)]
            fn as_mut_slice(&mut self) -> &mut [Self] {
                std::slice::from_mut(self)
            }

            #[inline(always)]
            fn gather(self, vectors: &[[Self; 3]], node: impl Fn(usize) -> u32) -> [Self; 3] {
                vectors[node(0) as usize]
            }

            #[inline(always)]
            fn add_vectors_by_lane(vector: &[Self; 3], sums: &mut [[Self; 3]], target: impl Fn(usize) -> u32) {
                let Some(sum) = sums.get_mut(target(0) as usize) else { return };
                for i in 0..3 {
                    sum[i] += vector[i];
                }
            }

            #[inline(always)]
            fn add_by_lane(block: &[[Self; 3]; 3], blocks: &mut [[[Self; 3]; 3]], target: impl Fn(usize) -> u32) {
                let Some(sums) = blocks.get_mut(target(0) as usize) else { return };
                for i in 0..3 {
                    for k in 0..3 {
                        sums[i][k] += block[i][k];
                    }
                }
            }
        }
    };
}

number!(f64);
number!(f32);

/// Implements [`Float`] for a float with its lanes, their number and [`Float::MAX_WIDTH`]; the conversions and the functions that
/// work on binary representations are given by the last argument.
macro_rules! real {
    ($float:ident, $lanes:ident, $fast:ident, $width:literal, $max_width:literal, { $($conversions:tt)* }) => {
        impl Float for $float {
            type Lanes = $lanes;
            type Fast = $fast;
            type Single = $float;
            const WIDTH: usize = $width;
            const MAX_WIDTH: usize = $max_width;
            const EPSILON: Self = $float::EPSILON;
            const MAX_EXPONENT: i32 = $float::MAX_EXP;

            #[inline(always)]
            fn lanes(value: impl FnMut(usize) -> $float) -> Self::Lanes {
                $lanes::from_lanes(value)
            }

            #[inline(always)]
            fn each(lanes: &Self::Lanes) -> &[$float] {
                lanes.as_array()
            }

            #[inline(always)]
            fn each_mut(lanes: &mut Self::Lanes) -> &mut [$float] {
                lanes.as_array_mut()
            }

            #[inline(always)]
            fn has_fast() -> bool {
                has_fast()
            }

            $($conversions)*
        }
    };
}

real!(f64, F64x4, FastF64, 4, 8, {
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
        f64::from_bits(CUBE_ROOT_F64.wrapping_sub((self.to_bits() >> 32) * THIRD))
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

    #[inline(always)]
    fn power_of_two(self) -> f64 {
        // Between the exponents of zero and infinity.
        let exponent = (self as i32).clamp(1 - Self::MAX_EXPONENT, Self::MAX_EXPONENT) + Self::MAX_EXPONENT - 1;
        f64::from_bits((exponent as u64) << 52)
    }
});

real!(f32, F32x8, FastF32, 8, 16, {
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
        let bits = self.to_bits();
        let third = (bits >> 2) + (bits >> 4);
        let third = third + (third >> 4);
        let third = third + (third >> 8);
        f32::from_bits(CUBE_ROOT_F32.wrapping_sub(third))
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

    #[inline(always)]
    fn power_of_two(self) -> f32 {
        // Between the exponents of zero and infinity.
        let exponent = (self as i32).clamp(1 - Self::MAX_EXPONENT, Self::MAX_EXPONENT) + Self::MAX_EXPONENT - 1;
        f32::from_bits((exponent as u32) << 23)
    }
});
