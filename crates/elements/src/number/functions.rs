//! Elementary functions of kernel numbers, without branches.

use super::{Float, Number};

/// The same constant in every lane.
#[inline(always)]
pub fn constant<T: Number>(x: f64) -> T {
    T::splat(T::Element::of(x))
}

/// Returns true if x is positive, finite and not subnormal.
pub fn is_positive<T: Float>(x: T) -> bool {
    let x = x.as_f64();
    // A number that is subnormal in single precision is normal in double.
    let least = if size_of::<T>() == 4 { f64::from(f32::MIN_POSITIVE) } else { f64::MIN_POSITIVE };
    x >= least && x.is_finite()
}

/// x^(−1/3) for x > 0; NaN or a meaningless number in lanes with x ≤ 0.
///
/// y (1 − r)^(−1/3) with r = 1 − x y³ by its series up to r³, twice, from a rough start: each step has four times as many digits as
/// the one before, with neither division nor branch.
#[inline(always)]
pub fn inverse_cube_root<T: Number>(x: T) -> T {
    let mut y = x.rough_inverse_cube_root();
    for _ in 0..2 {
        let r = (-(y * y)).times_plus(x * y, T::one());
        let of_square = r.times_plus(constant(14.0 / 81.0), constant(2.0 / 9.0));
        y = y.times_plus((r * r).times_plus(of_square, r * constant(1.0 / 3.0)), y);
    }
    y
}

/// x − ln(1 + x) for x > −1, to full relative accuracy also near zero, where it is x²/2.
///
/// 1 + x = 2^k (1 + y) leaves a small y, and with s = y/(2 + y), ln(1 + y) = 2 (s + s³/3 + s⁵/5 + …), y − 2s = y s.
#[inline(always)]
pub fn minus_ln_1p<T: Number>(x: T) -> T {
    let z = T::one() + x;
    let (k, m) = z.exponent_and_significand();
    // The sum z has lost digits of a small x.
    let y = x.select(k.eq(T::zero()), m - T::one());
    let s = y / (constant::<T>(2.0) + y);
    let squared = s * s;
    // |s| < 0.172: eleven terms are enough for f64.
    let mut series = T::zero();
    for n in (1..=11).rev() {
        series = series.times_plus(squared, constant(1.0 / f64::from(2 * n + 1)));
    }
    s * (y - constant::<T>(2.0) * squared * series) + ((x - y) - k * constant(std::f64::consts::LN_2))
}

/// ln 2 in two parts: multiples of the first by an exponent are exact.
const LN_2: [f64; 2] = [0.693145751953125, 1.428_606_820_309_417_2e-6];

/// e^x − 1 and e^x − 1 − x with all digits also near zero, where they are x and x²/2; infinity where e^x is above the range.
///
/// x = k ln 2 + r leaves a small r, and e^x = 2^k e^r with the series of e^r.
#[inline(always)]
pub fn exp_m1<T: Number>(x: T) -> [T; 2] {
    let limit = constant::<T>(f64::from(<T::Element as Float>::MAX_EXPONENT) * std::f64::consts::LN_2);
    // In this order NaN stays NaN.
    let inside = limit.min((-limit).max(x));
    // To this number, only integers can be added.
    let integers = constant::<T>(1.5 / Float::as_f64(<T::Element as Float>::EPSILON));
    let k = inside.times_plus(constant(std::f64::consts::LOG2_E), integers) - integers;
    let r = (inside - k * constant(LN_2[0])) - k * constant(LN_2[1]);
    // e^r − 1 − r = r²/2 (1 + r/3 (1 + r/4 (…))); |r| < 0.35: up to r¹⁵ they are enough for f64.
    let mut series = T::one();
    for n in (3..=15).rev() {
        series = series.times_plus(r * constant(1.0 / f64::from(n)), T::one());
    }
    let beyond = constant::<T>(0.5) * r * r * series;
    let power = k.map_lanes(
        #[inline(always)]
        |k| k.power_of_two(),
    );
    let change = power * (T::one() + (r + beyond)) - T::one();
    let is_small = k.eq(T::zero());
    [(r + beyond).select(is_small, change), beyond.select(is_small, change - x)]
}
