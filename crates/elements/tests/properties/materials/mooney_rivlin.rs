//! The Mooney–Rivlin law against its closed forms.

use super::*;
use fem_elements::materials::cauchy_stress;
use fem_elements::tensor::zero;

/// Energy density and diagonal of P at principal stretches: P_i = ∂ψ/∂λ_i, with λ̄ = J^(−1/3) λ.
fn in_stretches(law: &MooneyRivlin<f64>, stretches: [f64; 3]) -> (f64, [f64; 3]) {
    let J: f64 = stretches.iter().product();
    let squares = stretches.map(|stretch| J.powf(-2.0 / 3.0) * stretch * stretch);
    let (I1, I2): (f64, f64) = (squares.iter().sum(), squares.iter().map(|square| 1.0 / square).sum());
    let energy = law.C10 * (I1 - 3.0) + law.C01 * (I2 - 3.0) + law.D * (J - 1.0).powi(2);
    let stress = |i: usize| {
        let of_first = 2.0 * law.C10 * (squares[i] - I1 / 3.0);
        let of_second = 2.0 * law.C01 * (I2 / 3.0 - 1.0 / squares[i]);
        (of_first + of_second + 2.0 * law.D * (J - 1.0) * J) / stretches[i]
    };
    (energy, [stress(0), stress(1), stress(2)])
}

#[test]
fn bars_and_sheets_have_the_stress_of_the_closed_form() {
    let law = mooney_rivlin::<f64>();
    for stretches in STRETCHES {
        check_stretches(&law, stretches, in_stretches(&law, stretches));
    }
}

#[test]
fn a_bar_that_keeps_its_volume_is_pulled_as_the_textbooks_say() {
    let law = mooney_rivlin::<f64>();
    for stretch in [0.5f64, 0.99, 1.01, 1.5, 3.0] {
        let lateral = stretch.sqrt().recip();
        let G = minus_identity(&diagonal([stretch, lateral, lateral]));
        let sigma = cauchy_stress(&law.stress(&G), &G);
        let expected = 2.0 * (stretch * stretch - 1.0 / stretch) * (law.C10 + law.C01 / stretch);
        assert_near(sigma[0][0] - sigma[1][1], expected, &format!("pull at {stretch}"));
    }
}

#[test]
fn a_simple_shear_has_the_stresses_of_the_closed_form() {
    let law = mooney_rivlin::<f64>();
    for shear in [1e-3, 0.5, 2.0] {
        let mut G = zero();
        G[0][1] = shear;
        let sigma = cauchy_stress(&law.stress(&G), &G);
        assert_near(law.energy(&G), (law.C10 + law.C01) * shear * shear, "energy");
        assert_near(sigma[0][1], 2.0 * (law.C10 + law.C01) * shear, "shear stress");
        assert_near(sigma[0][0] - sigma[2][2], 2.0 * law.C10 * shear * shear, "first normal stress difference");
        assert_near(sigma[1][1] - sigma[2][2], -2.0 * law.C01 * shear * shear, "second normal stress difference");
    }
}

#[test]
fn a_change_of_volume_alone_has_the_pressure_of_the_volumetric_term() {
    let law = mooney_rivlin::<f64>();
    for s in VOLUMETRIC_STRETCHES {
        check_stretches(&law, [s; 3], volumetric(law.D, s));
    }
}

#[test]
fn with_zero_for_c01_it_is_the_neo_hookean_law() {
    let NeoHookean { C, D } = neo_hookean();
    check_is_neo_hookean(&MooneyRivlin { C10: C, C01: 0.0, D });
}

#[test]
fn the_second_invariant_alone_keeps_the_digits_of_its_energy_near_rest() {
    let law = MooneyRivlin { C10: 0.0, C01: 0.5 * MU, D: neo_hookean::<f64>().D };
    let mut random = Random(12);
    for _ in 0..200 {
        let G = random.tensor(1e-7);
        let (energy, hooke) = (law.energy(&G), linear::<f64>().energy(&G));
        assert!((energy / hooke - 1.0).abs() < 1e-6, "{energy:e} instead of {hooke:e} at {G:?}");
    }
}
