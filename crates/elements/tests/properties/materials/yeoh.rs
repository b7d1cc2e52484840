//! The Yeoh law against its closed forms.

use super::*;
use fem_elements::materials::cauchy_stress;
use fem_elements::tensor::zero;

/// Energy density and diagonal of P at principal stretches: P_i = ∂ψ/∂λ_i, with λ̄ = J^(−1/3) λ.
fn in_stretches(law: &Yeoh<f64>, stretches: [f64; 3]) -> (f64, [f64; 3]) {
    let J: f64 = stretches.iter().product();
    let squares = stretches.map(|stretch| J.powf(-2.0 / 3.0) * stretch * stretch);
    let e = squares.iter().sum::<f64>() - 3.0;
    let energy = law.C1 * e + law.C2 * e * e + law.C3 * e.powi(3) + law.D * (J - 1.0).powi(2);
    let slope = law.C1 + 2.0 * law.C2 * e + 3.0 * law.C3 * e * e;
    let stress = |i: usize| (2.0 * slope * (squares[i] - (e + 3.0) / 3.0) + 2.0 * law.D * (J - 1.0) * J) / stretches[i];
    (energy, [stress(0), stress(1), stress(2)])
}

#[test]
fn bars_and_sheets_have_the_stress_of_the_closed_form() {
    let law = yeoh::<f64>();
    for stretches in STRETCHES {
        check_stretches(&law, stretches, in_stretches(&law, stretches));
    }
}

/// C1 + 2 C2 e + 3 C3 e²
fn slope(law: &Yeoh<f64>, e: f64) -> f64 {
    law.C1 + 2.0 * law.C2 * e + 3.0 * law.C3 * e * e
}

#[test]
fn a_bar_that_keeps_its_volume_is_pulled_as_the_textbooks_say() {
    let law = yeoh::<f64>();
    for stretch in [0.5f64, 0.99, 1.01, 1.5, 3.0] {
        let lateral = stretch.sqrt().recip();
        let G = minus_identity(&diagonal([stretch, lateral, lateral]));
        let sigma = cauchy_stress(&law.stress(&G), &G);
        let e = stretch * stretch + 2.0 / stretch - 3.0;
        let expected = 2.0 * (stretch * stretch - 1.0 / stretch) * slope(&law, e);
        assert_near(sigma[0][0] - sigma[1][1], expected, &format!("pull at {stretch}"));
    }
}

#[test]
fn a_simple_shear_has_the_stresses_of_the_closed_form() {
    let law = yeoh::<f64>();
    for shear in [1e-3, 0.5, 2.0] {
        let mut G = zero();
        G[0][1] = shear;
        let (e, sigma) = (shear * shear, cauchy_stress(&law.stress(&G), &G));
        assert_near(law.energy(&G), law.C1 * e + law.C2 * e * e + law.C3 * e.powi(3), "energy");
        assert_near(sigma[0][1], 2.0 * slope(&law, e) * shear, "shear stress");
        assert_near(sigma[0][0] - sigma[2][2], 2.0 * slope(&law, e) * e, "first normal stress difference");
        assert_near(sigma[1][1] - sigma[2][2], 0.0, "second normal stress difference");
    }
}

#[test]
fn a_change_of_volume_alone_has_the_pressure_of_the_volumetric_term() {
    let law = yeoh::<f64>();
    for s in VOLUMETRIC_STRETCHES {
        check_stretches(&law, [s; 3], volumetric(law.D, s));
    }
}

#[test]
fn with_zero_for_c2_and_c3_it_is_the_neo_hookean_law() {
    let NeoHookean { C, D } = neo_hookean();
    check_is_neo_hookean(&Yeoh { C1: C, C2: 0.0, C3: 0.0, D });
}
