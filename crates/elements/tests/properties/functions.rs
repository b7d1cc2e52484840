use fem_elements::number::{inverse_cube_root, minus_ln_1p};

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
