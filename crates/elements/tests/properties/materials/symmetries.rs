//! Rotations of space and of the material.

use super::*;
use fem_elements::tensor::{plus_identity, product, transpose};

fn ignores_rotations(name: &str, law: &dyn Law<f64>) {
    let mut random = Random(9);
    for _ in 0..50 {
        let G = minus_identity(&random.rotation());
        assert!(law.energy(&G).abs() < 1e-14 * (MU + LAMBDA), "{name}: {}", law.energy(&G));
        assert!(largest(&law.stress(&G)) < 1e-14 * (MU + LAMBDA), "{name}: {:?}", law.stress(&G));
    }
}

#[test]
fn a_rotation_has_no_energy_and_no_stress() {
    for_all_objective_laws(ignores_rotations);
}

#[test]
fn the_linear_law_mistakes_a_rotation_for_a_strain() {
    // A quarter turn about z: ε = diag(−1, −1, 0).
    let G = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0; 3]];
    assert_eq!(linear::<f64>().energy(&G), 2.0 * MU + 2.0 * LAMBDA);
    assert_eq!(linear::<f64>().stress(&G), diagonal([-2.0 * (MU + LAMBDA), -2.0 * (MU + LAMBDA), -2.0 * LAMBDA]));
}

fn is_objective_and_isotropic(name: &str, law: &dyn Law<f64>) {
    let mut random = Random(10);
    for G in upright() {
        let (F, Q) = (plus_identity(&G), random.rotation());
        let (energy, P) = (law.energy(&G), law.stress(&G));
        let size = energy + largest(&P) + MU;
        let (turned, of_turned) = (minus_identity(&product(&Q, &F)), minus_identity(&product(&F, &Q)));
        assert!((law.energy(&turned) - energy).abs() < 1e-13 * size, "{name}: {G:?}");
        assert!((law.energy(&of_turned) - energy).abs() < 1e-13 * size, "{name}: {G:?}");
        let tolerance = 1e-12 * size * (1.0 + largest(&F));
        assert!(distance(&law.stress(&turned), &product(&Q, &P)) < tolerance, "{name}: {G:?}");
        assert!(distance(&law.stress(&of_turned), &product(&P, &Q)) < tolerance, "{name}: {G:?}");
        // Balance of angular momentum: Cauchy stress is symmetric.
        let tau = product(&P, &transpose(&F));
        assert!(distance(&tau, &transpose(&tau)) < tolerance, "{name}: {G:?}");
    }
}

#[test]
fn a_rotation_before_or_after_the_deformation_rotates_the_stress_and_keeps_the_energy() {
    for_all_objective_laws(is_objective_and_isotropic);
}
