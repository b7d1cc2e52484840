//! Deformations with a known stress.

use super::*;
use fem_elements::Real;
use fem_elements::materials::cauchy_stress;
use fem_elements::tensor::zero;

fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-13 * (MU + LAMBDA), "{found} instead of {expected}");
}

#[test]
fn the_stress_of_a_simple_shear_of_the_neo_hookean_law() {
    let law = neo_hookean::<f64>();
    for shear in [1e-3, 0.5, 2.0] {
        let mut G = zero();
        G[0][1] = shear;
        assert_near(law.energy(&G), law.C * shear * shear);
        let stress = cauchy_stress(&law.stress(&G), &G);
        let (along, across) = (4.0 * law.C * shear * shear / 3.0, -2.0 * law.C * shear * shear / 3.0);
        let expected = [[along, 2.0 * law.C * shear, 0.0], [2.0 * law.C * shear, across, 0.0], [0.0, 0.0, across]];
        assert!(distance(&stress, &expected) < 1e-13, "{stress:?}");
        let von_mises_expected = ((along - across).powi(2) + 12.0 * (law.C * shear).powi(2)).sqrt();
        let stress = nalgebra::Matrix3::from_fn(|i, j| stress[i][j]);
        assert_near(fem_output::von_mises(&stress), von_mises_expected);
    }
}

#[test]
fn the_stress_of_an_equal_stretch_in_all_directions() {
    for s in [0.3f64, 0.9, 1.1, 2.0] {
        let G = diagonal([s - 1.0; 3]);
        let law = neo_hookean::<f64>();
        let bulk = LAMBDA + 2.0 * MU / 3.0;
        assert!(distance(&law.stress(&G), &diagonal([2.0 * law.D * (s.powi(3) - 1.0) * s * s; 3])) < 1e-12);
        assert!(distance(&corotated::<f64>().stress(&G), &diagonal([3.0 * bulk * (s - 1.0); 3])) < 1e-12);
        let st_venant = 1.5 * bulk * s * (s * s - 1.0);
        assert!(distance(&st_venant_kirchhoff::<f64>().stress(&G), &diagonal([st_venant; 3])) < 1e-12);
        // Smith, de Goes and Kim (2018), eq. 14, differentiated: μ' (1 − 1/(I + 1)) s + λ' (s³ − α) s².
        let (mu, lambda) = (4.0 / 3.0 * MU, LAMBDA + 5.0 / 6.0 * MU);
        let alpha = 1.0 + 0.75 * mu / lambda;
        let stable = mu * (1.0 - 1.0 / (3.0 * s * s + 1.0)) * s + lambda * (s.powi(3) - alpha) * s * s;
        assert!(distance(&stable_neo_hookean::<f64>().stress(&G), &diagonal([stable; 3])) < 1e-12);
    }
}

#[test]
fn the_stable_neo_hookean_energy_is_the_published_one_up_to_a_constant() {
    let (mu, lambda) = (4.0 / 3.0 * MU, LAMBDA + 5.0 / 6.0 * MU);
    let alpha = 1.0 + 0.75 * mu / lambda;
    let published = |G: &Tensor<f64>| {
        let F = nalgebra::Matrix3::from_fn(|i, j| G[i][j] + f64::from(u8::from(i == j)));
        let I = F.norm_squared();
        mu / 2.0 * (I - 3.0) + lambda / 2.0 * (F.determinant() - alpha).powi(2) - mu / 2.0 * (I + 1.0).ln()
    };
    let at_rest = published(&zero());
    for G in any() {
        let (found, expected) = (stable_neo_hookean::<f64>().energy(&G), published(&G) - at_rest);
        assert!((found - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{found} instead of {expected} at {G:?}");
    }
}

#[test]
fn the_stress_of_a_neo_hookean_bar_pulled_along_x() {
    let law = neo_hookean::<f64>();
    for stretch in [0.7, 1.2, 2.0] {
        // The lateral stretch without lateral stress, by bisection.
        let lateral = |a: f64| {
            let J: f64 = stretch * a * a;
            2.0 * law.C / 3.0 * J.powf(-2.0 / 3.0) * (a * a - stretch * stretch) + 2.0 * law.D * (J - 1.0) * J
        };
        let (mut low, mut high) = (0.1, 3.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if lateral(middle) < 0.0 { low = middle } else { high = middle }
        }
        let J: f64 = stretch * low * low;
        let P11 = 2.0 * law.C / stretch * J.powf(-2.0 / 3.0) * (stretch * stretch - low * low);
        let P = law.stress(&diagonal([stretch - 1.0, low - 1.0, low - 1.0]));
        assert!(distance(&P, &diagonal([P11, 0.0, 0.0])) < 1e-12, "{P:?}");
    }
}

#[test]
fn the_corotated_law_pushes_a_mirrored_element_back() {
    let law = corotated::<f64>();
    let mirrored = diagonal([0.0, 0.0, -2.0]);
    assert_near(law.energy(&mirrored), 4.0 * MU + 2.0 * LAMBDA);
    let collapsed = diagonal([-1.0; 3]);
    assert_near(law.energy(&collapsed), 3.0 * MU + 4.5 * LAMBDA);
    let flat = diagonal([0.0, 0.0, -1.0]);
    assert!(distance(&law.stress(&flat), &diagonal([-LAMBDA, -LAMBDA, -2.0 * MU - LAMBDA])) < 1e-13);
}

#[test]
fn the_energy_of_a_flat_or_inverted_element_is_infinite_if_the_law_does_not_allow_it() {
    for law in laws::<f64>().iter().filter(|law| !law.allows_inversion()) {
        for thickness in [-1.0, -2.0] {
            assert_eq!(f64::law(law).energy(&diagonal([0.0, 0.0, thickness])), f64::INFINITY, "{}", law.name());
        }
    }
}
