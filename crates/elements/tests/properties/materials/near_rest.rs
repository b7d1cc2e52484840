//! Near rest all laws are Hooke's law, and their energies keep their digits.

use super::*;
use fem_elements::Real;
use fem_elements::tensor::zero;

fn is_at_rest(name: &str, law: &dyn Law<f64>) {
    assert_eq!(law.energy(&zero()), 0.0, "{name}");
    assert_eq!(largest(&law.stress(&zero())), 0.0, "{name}");
}

#[test]
fn energy_and_stress_at_rest_are_exactly_zero() {
    for_all_laws(is_at_rest);
}

fn has_moduli(name: &str, law: &dyn Law<f64>) {
    let hooke = linear::<f64>().derivative(&zero());
    let H = law.derivative(&zero());
    assert!(distance(&H, &hooke) < 1e-14, "{name}: {H:?}");
}

#[test]
fn the_derivative_at_rest_is_that_of_hookes_law_with_the_same_constants() {
    for_all_laws(has_moduli);
}

fn keeps_digits(name: &str, law: &dyn Law<f64>) {
    let mut random = Random(6);
    for _ in 0..200 {
        let G = random.tensor(1e-7);
        // The laws differ from Hooke's by terms of third order, a few 1e-7 of the energy.
        let (energy, hooke) = (law.energy(&G), linear::<f64>().energy(&G));
        assert!((energy / hooke - 1.0).abs() < 1e-6, "{name}: {energy:e} instead of {hooke:e} at {G:?}");
    }
}

#[test]
fn the_energy_of_a_strain_of_a_ten_millionth_is_right_to_a_millionth() {
    for_all_laws(keeps_digits);
}

fn keeps_single_digits(name: &str, law: &dyn Law<f32>) {
    let mut random = Random(7);
    for _ in 0..200 {
        let double = random.tensor(1e-3);
        let G = double.map(|row| row.map(|entry| entry as f32));
        let (energy, hooke) = (law.energy(&G), linear::<f32>().energy(&G));
        assert!((energy / hooke - 1.0).abs() < 1e-2, "{name}: {energy:e} instead of {hooke:e} at {G:?}");
        let (P, hooke) = (law.stress(&G), linear::<f32>().stress(&G));
        let error = distance(&P.map(|row| row.map(f64::from)), &hooke.map(|row| row.map(f64::from)));
        assert!(error < 1e-2 * largest(&hooke.map(|row| row.map(f64::from))), "{name}: {error:e} at {G:?}");
    }
}

#[test]
fn in_single_precision_energy_and_stress_of_a_strain_of_a_thousandth_are_right_to_a_hundredth() {
    laws().iter().for_each(|law| keeps_single_digits(law.name(), f32::law(law)));
}

/// The energy equals the work of the stress along a straight path, terms of third order included.
fn agrees_with_work(name: &str, law: &dyn Law<f64>) {
    let mut random = Random(8);
    for _ in 0..50 {
        let G = random.tensor(1e-4);
        // Simpson's rule is exact for stresses of third degree.
        let power = |s: f64| fem_elements::tensor::dot(&law.stress(&G.map(|row| row.map(|entry| s * entry))), &G);
        let work = (4.0 * power(0.5) + power(1.0)) / 6.0;
        let energy = law.energy(&G);
        assert!((energy / work - 1.0).abs() < 1e-9, "{name}: {energy:e} instead of {work:e}");
    }
}

#[test]
fn the_energy_of_a_small_strain_is_the_work_of_the_stress() {
    for_all_laws(agrees_with_work);
}

#[test]
fn an_energy_written_in_stretches_loses_those_digits() {
    let G = Random(6).tensor(1e-7);
    let F = fem_elements::tensor::plus_identity(&G);
    let J: f64 = 1.0 + fem_elements::tensor::volume_change(&G).0;
    let law = neo_hookean::<f64>();
    let naive = law.C * (J.powf(-2.0 / 3.0) * fem_elements::tensor::dot(&F, &F) - 3.0) + law.D * (J - 1.0) * (J - 1.0);
    assert!((naive / linear::<f64>().energy(&G) - 1.0).abs() > 1e-3, "the test above could not fail");
}

#[test]
fn the_corotated_stress_of_a_strain_of_a_billionth_keeps_its_digits() {
    let mut random = Random(9);
    for _ in 0..200 {
        let G = random.tensor(1e-9);
        let (P, hooke) = (corotated::<f64>().stress(&G), linear::<f64>().stress(&G));
        // The laws differ by the product of strain and rotation.
        assert!(distance(&P, &hooke) < 1e-8 * largest(&hooke), "{:e} at {G:?}", distance(&P, &hooke) / largest(&hooke));
    }
}
