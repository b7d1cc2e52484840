//! Near rest all laws are Hooke's law, and their energies keep their digits.

use super::*;
use fem_elements::Real;
use fem_elements::number::Number;
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

/// Energy and stress are those of Hooke's law but for terms of higher order and round-off: within `allowed` strains and epsilons.
fn is_hookes_law<T: Real + Number>(name: &str, law: &dyn Law<T>, strain: f64, [strains, epsilons]: [f64; 2]) {
    let (mut random, allowed) = (Random(7), strains * strain + epsilons * T::EPSILON.as_f64());
    let hooke = linear::<f64>();
    for _ in 0..200 {
        let G = random.tensor(strain).map(|row| row.map(T::of));
        let double = G.map(|row| row.map(T::as_f64));
        let (energy, expected) = (law.energy(&G).as_f64(), hooke.energy(&double));
        assert!((energy / expected - 1.0).abs() < allowed, "{name}: {energy:e} instead of {expected:e} at {G:?}");
        let (P, expected) = (law.stress(&G).map(|row| row.map(T::as_f64)), hooke.stress(&double));
        let error = distance(&P, &expected) / largest(&expected);
        assert!(error < allowed, "{name}: a stress {error:e} off at {G:?}");
    }
}

#[test]
fn a_small_strain_loses_no_digits_of_energy_and_stress_in_double_and_single_precision() {
    for strain in [1e-3, 1e-5, 1e-7, 1e-9, 1e-12] {
        laws().iter().for_each(|law| is_hookes_law(law.name(), f64::law(law), strain, [10.0, 100.0]));
        laws().iter().for_each(|law| is_hookes_law(law.name(), f32::law(law), strain, [10.0, 100.0]));
    }
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
