//! Numbers that kernels compute with: `f32`, `f64`, or lanes of them.
//!
//! A kernel is written once over [`Number`]. For one element a number is a float; for a batch of elements it is one float of
//! each element, and an instruction of the processor works on all of them ([`vectorized`]).

mod packed;

pub use packed::Packed;

use faer::traits::RealField as FaerReal;
use nalgebra::RealField;
use simba::simd::{SimdRealField, SimdValue, WideF32x8, WideF64x4};

/// The float that a whole simulation runs in.
pub trait Real: RealField + FaerReal + Packed + Default + std::iter::Sum {
    /// As many of them as a register of 256 bits holds.
    type Lanes: Number<Element = Self>;
    /// How many that is.
    const WIDTH: usize;
    /// How many fill the widest register of any processor: what panels of dense matrices are padded to.
    const WIDEST: usize;
    /// Relative distance from 1 to the next number.
    const EPSILON: Self;

    /// Lane by lane.
    fn lanes(value: impl FnMut(usize) -> Self) -> Self::Lanes;

    /// The numbers of all lanes.
    fn each(lanes: &Self::Lanes) -> &[Self];

    /// The same, to be written.
    fn each_mut(lanes: &mut Self::Lanes) -> &mut [Self];

    /// Adds what the lanes of a block hold to the block `target(lane)`, unless that is out of range. By registers, not by numbers: a pass
    /// over elements spends much of its time on getting numbers out of lanes.
    fn add_by_lane<const D: usize>(
        lanes: &[[Self::Lanes; D]; D],
        blocks: &mut [[[Self; D]; D]],
        target: impl Fn(usize) -> u32,
    );

    /// The nearest number of this type.
    fn of(x: f64) -> Self;

    /// The same number, exactly.
    fn as_f64(self) -> f64;

    /// x^(−1/3) to a few percent, for normal x > 0: a third of the exponent, by way of the bits.
    fn rough_inverse_cube_root(self) -> Self;

    /// The integer k for which x/2^k lies in [√½, √2), for normal x > 0.
    fn binary_exponent(self) -> Self;

    /// That x/2^k.
    fn significand(self) -> Self;
}

impl Real for f64 {
    type Lanes = WideF64x4;
    const WIDTH: usize = 4;
    const WIDEST: usize = 8;
    const EPSILON: Self = f64::EPSILON;

    #[inline(always)]
    fn lanes(value: impl FnMut(usize) -> f64) -> Self::Lanes {
        WideF64x4(wide::f64x4::new(std::array::from_fn(value)))
    }

    #[inline(always)]
    fn each(lanes: &Self::Lanes) -> &[f64] {
        lanes.0.as_array()
    }

    #[inline(always)]
    fn each_mut(lanes: &mut Self::Lanes) -> &mut [f64] {
        lanes.0.as_mut_array()
    }

    #[inline(always)]
    fn add_by_lane<const D: usize>(
        lanes: &[[Self::Lanes; D]; D],
        blocks: &mut [[[f64; D]; D]],
        target: impl Fn(usize) -> u32,
    ) {
        let (full, rest) = lanes.as_flattened().as_chunks::<4>();
        let mut rows = [[wide::f64x4::ZERO; 4]; 2];
        for (rows, lanes) in rows.iter_mut().zip(full) {
            *rows = wide::f64x4::transpose(lanes.map(|lanes| lanes.0));
        }
        for lane in 0..4 {
            let Some(block) = blocks.get_mut(target(lane) as usize) else { continue };
            let (sums, last) = block.as_flattened_mut().as_chunks_mut::<4>();
            for (sums, rows) in sums.iter_mut().zip(&rows) {
                *sums = (wide::f64x4::new(*sums) + rows[lane]).to_array();
            }
            for (sum, lanes) in last.iter_mut().zip(rest) {
                *sum += lanes.0.as_array()[lane];
            }
        }
    }

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
        // Exponents beyond those of f32 are cut off, and Newton's iteration then needs more steps than it takes: no element
        // is squashed or stretched by 1e38.
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
}

impl Real for f32 {
    type Lanes = WideF32x8;
    const WIDTH: usize = 8;
    const WIDEST: usize = 16;
    const EPSILON: Self = f32::EPSILON;

    #[inline(always)]
    fn lanes(value: impl FnMut(usize) -> f32) -> Self::Lanes {
        WideF32x8(wide::f32x8::new(std::array::from_fn(value)))
    }

    #[inline(always)]
    fn each(lanes: &Self::Lanes) -> &[f32] {
        lanes.0.as_array()
    }

    #[inline(always)]
    fn each_mut(lanes: &mut Self::Lanes) -> &mut [f32] {
        lanes.0.as_mut_array()
    }

    #[inline(always)]
    fn add_by_lane<const D: usize>(
        lanes: &[[Self::Lanes; D]; D],
        blocks: &mut [[[f32; D]; D]],
        target: impl Fn(usize) -> u32,
    ) {
        let (full, rest) = lanes.as_flattened().as_chunks::<8>();
        let mut rows = [[wide::f32x8::ZERO; 8]; 2];
        for (rows, lanes) in rows.iter_mut().zip(full) {
            *rows = wide::f32x8::transpose(lanes.map(|lanes| lanes.0));
        }
        for lane in 0..8 {
            let Some(block) = blocks.get_mut(target(lane) as usize) else { continue };
            let (sums, last) = block.as_flattened_mut().as_chunks_mut::<8>();
            for (sums, rows) in sums.iter_mut().zip(&rows) {
                *sums = (wide::f32x8::new(*sums) + rows[lane]).to_array();
            }
            for (sum, lanes) in last.iter_mut().zip(rest) {
                *sum += lanes.0.as_array()[lane];
            }
        }
    }

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
}

/// What a kernel computes with: one [`Real`], or lanes of them.
pub trait Number: SimdRealField + SimdValue<Element: Real> + Copy {}

impl<T: SimdRealField + SimdValue<Element: Real> + Copy> Number for T {}

/// The same constant in every lane.
#[inline(always)]
pub fn constant<T: Number>(x: f64) -> T {
    T::splat(T::Element::of(x))
}

/// x^(−1/3) for x > 0; NaN or nonsense in lanes where x ≤ 0.
///
/// Newton's iteration for y⁻³ = x from a rough start: no division, no branch, and four steps double the digits to all of them.
#[inline(always)]
pub fn inverse_cube_root<T: Number>(x: T) -> T {
    let mut y = x.map_lanes(
        #[inline(always)]
        |x| x.rough_inverse_cube_root(),
    );
    for _ in 0..4 {
        y *= (constant::<T>(4.0) - x * y * y * y) * constant(1.0 / 3.0);
    }
    y
}

/// x − ln(1 + x) for x > −1, with all its digits also near zero, where it is x²/2.
///
/// 1 + x = 2^k (1 + y) leaves a small y, and with s = y/(2 + y), ln(1 + y) = 2 (s + s³/3 + s⁵/5 + …), y − 2s = y s.
#[inline(always)]
pub fn minus_ln_1p<T: Number>(x: T) -> T {
    let z = T::one() + x;
    let k = z.map_lanes(
        #[inline(always)]
        |z| z.binary_exponent(),
    );
    let m = z.map_lanes(
        #[inline(always)]
        |z| z.significand(),
    );
    // The sum z has lost digits of a small x.
    let y = x.select(k.simd_eq(T::zero()), m - T::one());
    let s = y / (constant::<T>(2.0) + y);
    let squared = s * s;
    // |s| < 0.172: eleven terms are enough for f64.
    let mut series = T::zero();
    for n in (1..=11).rev() {
        series = series * squared + constant(1.0 / f64::from(2 * n + 1));
    }
    s * (y - constant::<T>(2.0) * squared * series) + ((x - y) - k * constant(std::f64::consts::LN_2))
}

/// Runs `work` with the widest instructions that this processor has; what it calls must be inlined into it.
///
/// Work is a type of its own, not a closure: only its `with_simd`, marked `inline(always)`, is compiled once more for each
/// processor.
#[inline(always)]
pub fn vectorized<W: pulp::WithSimd>(work: W) -> W::Output {
    pulp::Arch::new().dispatch(work)
}

#[cfg(test)]
mod tests {
    use super::{inverse_cube_root, minus_ln_1p};

    #[test]
    fn the_distance_between_a_number_and_the_logarithm_of_one_more_keeps_its_digits() {
        for exponent in -60..=60 {
            for factor in [1.0, -1.0, 1.7, -1.9, 0.7, -0.55] {
                let x: f64 = factor * 2f64.powi(exponent);
                if x <= -0.95 {
                    continue;
                }
                // Below, the series; above, the library, which loses no digits there.
                let series = x * x / 2.0 - x.powi(3) / 3.0 + x.powi(4) / 4.0 - x.powi(5) / 5.0 + x.powi(6) / 6.0;
                let expected = if x.abs() < 1e-3 { series } else { x - x.ln_1p() };
                let tolerance = 1e-15 + 4e-16 / x.abs().min(1.0);
                let (y, y32) = (minus_ln_1p(x), f64::from(minus_ln_1p(x as f32)));
                assert!((y / expected - 1.0).abs() < if x.abs() < 1e-3 { 2e-15 } else { 4.0 * tolerance }, "{x}: {y}");
                assert!((y32 / expected - 1.0).abs() < 1e-6, "{x}: {y32}");
            }
        }
        assert_eq!(minus_ln_1p(0.0), 0.0);
    }

    #[test]
    fn of_what_has_none_nothing_finite_or_a_panic_is_made() {
        for x in [f64::NAN, -f64::NAN, -f64::INFINITY] {
            assert!(!inverse_cube_root(x).is_finite() && !inverse_cube_root(x as f32).is_finite(), "{x}");
            assert!(!minus_ln_1p(x).is_finite() && !minus_ln_1p(x as f32).is_finite(), "{x}");
        }
    }

    #[test]
    fn inverse_cube_roots_are_right_to_a_few_units_in_the_last_place() {
        for exponent in -30..=30 {
            for mantissa in [1.0, 1.3, 1.9, 2.5, 7.7] {
                let x: f64 = mantissa * 10f64.powi(exponent);
                let (y, y32) = (inverse_cube_root(x), inverse_cube_root(x as f32));
                assert!((y * x.cbrt() - 1.0).abs() < 1e-15, "{x}: {y}");
                assert!((y32 * (x as f32).cbrt() - 1.0).abs() < 1e-6, "{x}: {y32}");
            }
        }
    }
}
