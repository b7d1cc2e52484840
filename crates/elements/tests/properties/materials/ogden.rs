//! The Ogden law against its closed forms.

use super::*;
use fem_elements::materials::cauchy_stress;
use fem_elements::tensor::{plus_identity, product};

/// One term beside which the others are absent.
fn single(mu: f64, alpha: f64, D: f64) -> Ogden<f64> {
    Ogden { mu: [mu, 0.0, 0.0], alpha: [alpha, 1.0, 1.0], D }
}

fn terms(law: &Ogden<f64>) -> impl Iterator<Item = (f64, f64)> {
    law.mu.into_iter().zip(law.alpha)
}

/// Energy density and diagonal of P at principal stretches: P_i = ∂ψ/∂λ_i, with λ̄ = J^(−1/3) λ.
fn in_stretches(law: &Ogden<f64>, stretches: [f64; 3]) -> (f64, [f64; 3]) {
    let J: f64 = stretches.iter().product();
    let isochoric = stretches.map(|stretch| J.cbrt().recip() * stretch);
    let sum = |alpha: f64| isochoric.iter().map(|stretch| stretch.powf(alpha)).sum::<f64>();
    let energy: f64 = terms(law).map(|(mu, alpha)| mu / alpha * (sum(alpha) - 3.0)).sum();
    let stress = |i: usize| {
        let of_term = |(mu, alpha): (f64, f64)| mu * (isochoric[i].powf(alpha) - sum(alpha) / 3.0);
        (terms(law).map(of_term).sum::<f64>() + 2.0 * law.D * (J - 1.0) * J) / stretches[i]
    };
    (energy + law.D * (J - 1.0).powi(2), [stress(0), stress(1), stress(2)])
}

#[test]
fn bars_and_sheets_have_the_stress_of_the_closed_form() {
    for law in [ogden(), single(0.4, -7.0, 2.5), single(0.01, 11.5, 2.5), single(-3.0, -0.3, 2.5)] {
        for stretches in STRETCHES {
            check_stretches(&law, stretches, in_stretches(&law, stretches));
        }
    }
}

/// Ogden (1972), the constants of Treloar's rubber, kg/cm².
const TRELOAR: Ogden<f64> = Ogden { mu: [6.3, 0.012, -0.1], alpha: [1.3, 5.0, -2.0], D: 1e3 };

#[test]
fn rubber_that_keeps_its_volume_is_pulled_as_ogden_says() {
    for stretch in [0.5f64, 0.99, 1.01, 1.5, 3.0, 6.0] {
        // Simple tension, equibiaxial tension and pure shear: Ogden (1972), eqs. 21 to 24, with the power of the other stretch.
        for (lateral, other) in [(-0.5, -0.5), (1.0, -2.0), (0.0, -1.0)] {
            let stretches = [stretch, stretch.powf(lateral), stretch.powf(-1.0 - lateral)];
            let G = minus_identity(&diagonal(stretches));
            let sigma = cauchy_stress(&TRELOAR.stress(&G), &G);
            let nominal = (sigma[0][0] - sigma[2][2]) / stretch;
            let expected: f64 = terms(&TRELOAR)
                .map(|(mu, alpha)| mu * (stretch.powf(alpha - 1.0) - stretch.powf(other * alpha - 1.0)))
                .sum();
            assert!(
                (nominal - expected).abs() < 1e-12 * (TRELOAR.D + expected.abs()),
                "{stretches:?}: {nominal} {expected}"
            );
        }
    }
}

#[test]
fn a_change_of_volume_alone_has_the_pressure_of_the_volumetric_term() {
    for s in VOLUMETRIC_STRETCHES {
        check_stretches(&ogden(), [s; 3], volumetric(ogden::<f64>().D, s));
    }
}

/// Two laws have the same energy, stress and derivative at every deformation.
fn check_is_same(law: &dyn Law<f64>, other: &dyn Law<f64>) {
    for G in upright() {
        let (energy, P, H) = (other.energy(&G), other.stress(&G), other.derivative(&G));
        // Rounding errors of F count as much as the slopes.
        let rounding = 1e-13 * (1.0 + largest(&plus_identity(&G)));
        let error = (law.energy(&G) - energy).abs();
        assert!(error <= 1e-13 * (MU + energy) + rounding * largest(&P), "{error:e} of {energy:e} at {G:?}");
        let tolerance = rounding * largest(&H);
        let error = distance(&law.stress(&G), &P);
        assert!(error <= tolerance, "{error:e} of {tolerance:e} at {G:?}");
        let error = distance(&law.derivative(&G), &H) / largest(&H);
        assert!(error <= 1e-11, "{error:e} at {G:?}");
        let (found, expected) = (law.projected_derivative(&G), other.projected_derivative(&G));
        assert!(distance(&found, &expected) <= 1e-11 * largest(&H), "{G:?}");
    }
}

#[test]
fn with_the_exponent_2_it_is_the_neo_hookean_law() {
    let neo = neo_hookean::<f64>();
    check_is_same(&single(2.0 * neo.C, 2.0, neo.D), &neo);
}

#[test]
fn with_the_exponents_2_and_minus_2_it_is_the_mooney_rivlin_law() {
    let mooney = mooney_rivlin::<f64>();
    let mu = [2.0 * mooney.C10, -2.0 * mooney.C01, 0.0];
    check_is_same(&Ogden { mu, alpha: [2.0, -2.0, 1.0], D: mooney.D }, &mooney);
}

#[test]
fn stretches_that_become_equal_change_nothing_abruptly() {
    let mut random = Random(3);
    let (U, V) = (random.rotation(), random.rotation());
    for equal in [0.4, 1.0, 2.5] {
        let at = |apart: f64| {
            let F = product(&product(&U, &diagonal([equal + apart, equal, 0.7])), &V);
            minus_identity(&F)
        };
        let law = ogden::<f64>();
        let (P, H) = (law.stress(&at(0.0)), law.derivative(&at(0.0)));
        for exponent in 2..=16 {
            let apart = 10f64.powi(-exponent);
            // The slopes of stress and derivative, and rounding errors.
            let tolerance = (1e2 * apart + 1e-13) * largest(&H);
            assert!(distance(&law.stress(&at(apart)), &P) < tolerance, "stress, {apart:e} apart");
            assert!(distance(&law.derivative(&at(apart)), &H) < tolerance, "derivative, {apart:e} apart");
            assert!(distance(&law.projected_derivative(&at(apart)), &law.projected_derivative(&at(0.0))) < tolerance);
        }
    }
}

#[test]
fn extreme_stretches_have_the_stress_of_the_closed_form_or_an_infinite_energy() {
    for stretches in [[1e3, 1.0, 1e-3], [1e-4, 1e-4, 1e-4], [50.0, 50.0, 1e-3], [1e5, 1e5, 1e5]] {
        let (law, G) = (ogden::<f64>(), minus_identity(&diagonal(stretches)));
        let (energy, stress) = in_stretches(&law, stretches);
        assert!((law.energy(&G) / energy - 1.0).abs() < 1e-11, "{stretches:?}");
        // Of a change of volume alone, rounding errors of the stretches are all of the stress of the terms.
        let smallest = stretches.into_iter().fold(f64::INFINITY, f64::min);
        let size = stress.iter().fold(1e-3 * MU / smallest, |size: f64, stress| size.max(stress.abs()));
        assert!(distance(&law.stress(&G), &diagonal(stress)) < 1e-11 * size, "{stretches:?}");
        let H = law.derivative(&G);
        assert!(H.as_flattened().iter().all(|entry| entry.is_finite()), "{stretches:?}");
    }
    // Above the range of a number, and of opposite signs.
    for law in [single(1.0, 200.0, 1.0), Ogden { mu: [1.0, -1.0, 0.0], alpha: [200.0, 150.0, 1.0], D: 1.0 }] {
        for stretches in [[1e3, 1.0, 1e-3], [1e30, 1.0, 1e-30]] {
            assert_eq!(law.energy(&minus_identity(&diagonal(stretches))), f64::INFINITY, "{law:?}");
        }
    }
}

#[test]
fn the_energy_ignores_rotations() {
    let mut random = Random(4);
    let law = ogden::<f64>();
    for G in upright() {
        let R = random.rotation();
        let turned = minus_identity(&product(&R, &plus_identity(&G)));
        assert!((law.energy(&turned) / law.energy(&G) - 1.0).abs() < 1e-6 || law.energy(&G) < 1e-8, "{G:?}");
        let P = product(&R, &law.stress(&G));
        assert!(distance(&law.stress(&turned), &P) < 1e-12 * (largest(&P) + MU), "{G:?}");
    }
}
