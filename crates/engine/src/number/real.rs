//! The floats that a simulation runs in, and their SIMD lanes.

use faer::traits::RealField as FaerReal;
use nalgebra::RealField;

#[cfg(target_arch = "x86_64")]
use super::avx2::{Avx2F32x8 as FastF32, Avx2F64x4 as FastF64, is_available as has_fast};
use super::lanes::{F32x8, F64x4};
#[cfg(not(target_arch = "x86_64"))]
use super::lanes::{F32x8 as FastF32, F64x4 as FastF64};
use super::{Lanes, Packed};

/// Other processors have one kind of lanes.
#[cfg(not(target_arch = "x86_64"))]
fn has_fast() -> bool {
    true
}

/// The float that a whole simulation runs in.
pub trait Real: RealField + FaerReal + Packed + Default + std::iter::Sum {
    /// As many of them as a register of 256 bits holds, on any processor: the form in which lanes are stored.
    type Lanes: Lanes<Element = Self>;
    /// The same for processors that [have](Self::has_fast) wide registers.
    type Fast: Lanes<Element = Self>;
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

    /// Whether this processor has the instructions of [`Fast`](Self::Fast).
    fn has_fast() -> bool;

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

/// The bits of x^(−1/3) are about these minus a third of those of x, which shifts and additions find: (¼ + 1/16) (1 + 1/16) (1 + 1/256) …
pub(super) const CUBE_ROOT_F64: u64 = 0x553e_f0ff_289d_d796;
pub(super) const CUBE_ROOT_F32: u32 = 0x54a2_fa8c;

/// Implements [`Real`] for a float with its lanes, their number and [`Real::MAX_WIDTH`]; the conversions and the functions that
/// work on binary representations are given by the last argument.
macro_rules! real {
    ($float:ident, $lanes:ident, $fast:ident, $width:literal, $max_width:literal, { $($conversions:tt)* }) => {
        impl Real for $float {
            type Lanes = $lanes;
            type Fast = $fast;
            const WIDTH: usize = $width;
            const MAX_WIDTH: usize = $max_width;
            const EPSILON: Self = $float::EPSILON;

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
        let bits = self.to_bits();
        let third = (bits >> 2) + (bits >> 4);
        let third = third + (third >> 4);
        let third = third + (third >> 8);
        let third = third + (third >> 16);
        f64::from_bits(CUBE_ROOT_F64.wrapping_sub(third))
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
});
