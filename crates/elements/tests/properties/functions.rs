use fem_elements::number::{exp_m1, inverse_cube_root, minus_ln_1p};

#[test]
fn x_minus_the_logarithm_of_1_plus_x_is_accurate_near_zero() {
    for exponent in -60..=60 {
        for factor in [1.0, -1.0, 1.7, -1.9, 0.7, -0.55] {
            let x: f64 = factor * 2f64.powi(exponent);
            if x <= -0.95 {
                continue;
            }
            // The series for small x; the library where it loses no digits.
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
fn exponentials_minus_one_are_accurate_near_zero_and_over_the_whole_range() {
    for exponent in -60..=9 {
        for factor in [1.0, -1.0, 1.7, -1.9, 0.7, -0.55] {
            let x: f64 = factor * 2f64.powi(exponent);
            let [y, beyond] = exp_m1(x);
            let series = x * x / 2.0 + x.powi(3) / 6.0 + x.powi(4) / 24.0 + x.powi(5) / 120.0;
            let expected = if x.abs() < 1e-3 { series } else { x.exp_m1() - x };
            let lost = if x.abs() < 1e-3 { 2e-15 } else { 1e-15 + 4e-16 / x.abs().min(1.0) };
            if x > 709.0 {
                assert_eq!([y, beyond], [f64::INFINITY; 2], "{x}");
                continue;
            }
            assert!((y / x.exp_m1() - 1.0).abs() < 2e-15, "{x}: {y}");
            assert!((beyond / expected - 1.0).abs() < 4.0 * lost, "{x}: {beyond}");
            let [y, beyond] = exp_m1(x as f32).map(f64::from);
            if x > 88.0 {
                assert_eq!([y, beyond], [f64::INFINITY; 2], "{x}");
                continue;
            }
            // The rounding of x changes e^x by this part.
            let tolerance = 4e-6 * x.abs().max(1.0);
            assert!(
                (y / x.exp_m1() - 1.0).abs() < tolerance && (beyond / expected - 1.0).abs() < tolerance,
                "{x}: {y}"
            );
        }
    }
    assert_eq!(exp_m1(0.0), [0.0; 2]);
    assert_eq!([exp_m1(f64::INFINITY)[0], exp_m1(f64::NEG_INFINITY)[0]], [f64::INFINITY, -1.0]);
    assert!(exp_m1(f64::NAN).into_iter().all(f64::is_nan) && exp_m1(f32::NAN).into_iter().all(f32::is_nan));
}

#[test]
fn arguments_outside_the_domain_give_no_finite_value() {
    for x in [f64::NAN, -f64::NAN, -f64::INFINITY] {
        assert!(!inverse_cube_root(x).is_finite() && !inverse_cube_root(x as f32).is_finite(), "{x}");
        assert!(!minus_ln_1p(x).is_finite() && !minus_ln_1p(x as f32).is_finite(), "{x}");
    }
}

#[test]
fn inverse_cube_roots_are_accurate_to_a_few_units_in_the_last_place() {
    for exponent in -30..=30 {
        for mantissa in [1.0, 1.3, 1.9, 2.5, 7.7] {
            let x: f64 = mantissa * 10f64.powi(exponent);
            let (y, y32) = (inverse_cube_root(x), inverse_cube_root(x as f32));
            assert!((y * x.cbrt() - 1.0).abs() < 1e-15, "{x}: {y}");
            assert!((y32 * (x as f32).cbrt() - 1.0).abs() < 1e-6, "{x}: {y32}");
        }
    }
}
