//! The Gent law against its closed forms.

use super::*;
use fem_elements::materials::cauchy_stress;
use fem_elements::tensor::zero;

/// A law whose chains are short.
const SHORT: Gent<f64> = Gent { C: 0.75, Jm: 12.0, D: 2.5 };

/// Energy density and diagonal of P at principal stretches: P_i = ∂ψ/∂λ_i, with λ̄ = J^(−1/3) λ.
fn in_stretches(law: &Gent<f64>, stretches: [f64; 3]) -> (f64, [f64; 3]) {
    let J: f64 = stretches.iter().product();
    let squares = stretches.map(|stretch| J.powf(-2.0 / 3.0) * stretch * stretch);
    let e = squares.iter().sum::<f64>() - 3.0;
    let energy = -law.C * law.Jm * (-e / law.Jm).ln_1p() + law.D * (J - 1.0).powi(2);
    let slope = law.C / (1.0 - e / law.Jm);
    let stress = |i: usize| (2.0 * slope * (squares[i] - (e + 3.0) / 3.0) + 2.0 * law.D * (J - 1.0) * J) / stretches[i];
    (energy, [stress(0), stress(1), stress(2)])
}

#[test]
fn bars_and_sheets_have_the_stress_of_the_closed_form() {
    for stretches in STRETCHES {
        check_stretches(&gent(), stretches, in_stretches(&gent(), stretches));
    }
}

#[test]
fn a_bar_of_short_chains_is_pulled_as_the_textbooks_say() {
    for stretch in [0.5f64, 0.99, 1.01, 2.0, 3.5] {
        let lateral = stretch.sqrt().recip();
        let G = minus_identity(&diagonal([stretch, lateral, lateral]));
        let sigma = cauchy_stress(&SHORT.stress(&G), &G);
        let e = stretch * stretch + 2.0 / stretch - 3.0;
        // Horgan and Saccomandi, A molecular-statistical basis for the Gent constitutive model (2002), eq. 13.
        let expected = 2.0 * SHORT.C * SHORT.Jm / (SHORT.Jm - e) * (stretch * stretch - 1.0 / stretch);
        assert_near(sigma[0][0] - sigma[1][1], expected, &format!("pull at {stretch}"));
    }
}

#[test]
fn chains_that_are_stretched_out_have_an_infinite_energy() {
    let mut G = zero();
    for (shear, is_allowed) in [(3.46, true), (3.47, false), (50.0, false)] {
        G[0][1] = shear; // Ī − 3 is its square.
        assert_eq!(SHORT.energy(&G).is_finite(), is_allowed, "{shear}");
    }
}

#[test]
fn a_change_of_volume_alone_has_the_pressure_of_the_volumetric_term() {
    for s in VOLUMETRIC_STRETCHES {
        check_stretches(&SHORT, [s; 3], volumetric(SHORT.D, s));
    }
}

#[test]
fn with_endless_chains_it_is_the_neo_hookean_law() {
    let NeoHookean { C, D } = neo_hookean();
    check_is_neo_hookean(&Gent { C, Jm: 1e18, D });
}
