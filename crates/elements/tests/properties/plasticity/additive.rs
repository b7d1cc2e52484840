//! The additive model.

use super::*;
use fem_elements::tensor::zero;

const YIELD: f64 = 0.05;
const MAXIMUM: f64 = 0.6;

fn law(plastic: Tensor<f64>) -> Additive<f64> {
    Additive { mu: 1.5, lambda: 4.0, plastic, is_in_plane: false }
}

/// A symmetric plastic strain.
fn plastic(random: &mut Random, size: f64) -> Tensor<f64> {
    let a = random.tensor(size);
    from_fn(|i, j| 0.5 * (a[i][j] + a[j][i]))
}

#[test]
fn stress_and_tangent_are_the_derivatives_of_the_energy_with_a_plastic_strain_in_any_direction() {
    let mut random = Random(1);
    for _ in 0..200 {
        let law = law(plastic(&mut random, 0.3));
        assert_consistent(&law, &random.tensor(0.4));
    }
}

#[test]
fn an_inverted_element_has_a_consistent_tangent_away_from_the_crease() {
    let mut random = Random(2);
    let mut found = 0;
    while found < 30 {
        let (law, G) = (law(plastic(&mut random, 0.3)), random.tensor(1.5));
        let sigma = fem_elements::svd::svd(&plus_identity(&G)).sigma;
        if sigma[2] < -0.1 && sigma[1] + sigma[2] > 0.3 {
            assert_consistent(&law, &G);
            found += 1;
        }
    }
}

#[test]
fn a_rotation_of_the_body_rotates_the_stress() {
    let mut random = Random(3);
    for _ in 0..100 {
        let law = law(plastic(&mut random, 0.3));
        let (G, Q) = (random.tensor(0.4), random.rotation());
        assert_objective(&law, &G, &Q);
    }
}

#[test]
fn without_plastic_strain_it_is_the_corotated_law() {
    let mut random = Random(4);
    let elastic = fem_elements::materials::Corotated { mu: 1.5, lambda: 4.0 };
    for _ in 0..50 {
        let G = random.tensor(0.5);
        assert!((law(zero()).energy(&G) - elastic.energy(&G)).abs() < 1e-13);
        assert!(difference(&law(zero()).stress(&G), &elastic.stress(&G)) < 1e-13);
        let (found, expected) = (law(zero()).derivative(&G), elastic.derivative(&G));
        let error = found.as_flattened().iter().zip(expected.as_flattened()).map(|(a, b)| (a - b).abs());
        assert!(error.fold(0.0, f64::max) < 1e-12);
    }
}

#[test]
fn a_body_deformed_to_its_plastic_strain_is_at_rest() {
    let mut random = Random(5);
    let law = law(plastic(&mut random, 0.2));
    let at_rest = minus_identity(&product(&random.rotation(), &plus_identity(&law.plastic)));
    assert!(law.energy(&at_rest) < 1e-28, "{:e}", law.energy(&at_rest));
    assert!(norm(&law.stress(&at_rest)) < 1e-13);
}

/// The elastic strain after `steps` of `dt` seconds at a fixed displacement gradient.
fn elastic_strain(G: &Tensor<f64>, creep: f64, dt: f64, steps: usize) -> f64 {
    let mut of = law(zero());
    for _ in 0..steps {
        of.plastic = of.flow(G, YIELD, -(-creep * dt).exp_m1(), MAXIMUM).0.plastic;
    }
    let E = of.energy(G);
    // λ = 0 makes the energy μ |εᵉ|².
    let shear = Additive { lambda: 0.0, ..of };
    assert!(shear.energy(G) <= E);
    (shear.energy(G) / shear.mu).sqrt()
}

#[test]
fn the_elastic_strain_of_a_held_body_decays_to_the_yield_strain_as_the_closed_form_says_whatever_the_step() {
    let G = [[0.12, 0.3, 0.0], [-0.1, 0.05, 0.02], [0.0, 0.04, -0.08]];
    let first = elastic_strain(&G, 2.0, 0.1, 0);
    assert!(first > 3.0 * YIELD, "{first}");
    for (dt, steps) in [(0.5, 2), (0.1, 10), (0.001, 1000)] {
        let expected = YIELD + (first - YIELD) * (-2.0f64).exp();
        let found = elastic_strain(&G, 2.0, dt, steps);
        assert!((found - expected).abs() < 1e-12, "{found} and not {expected} with {dt} s");
    }
    let small = G.map(|row| row.map(|entry| 0.1 * entry));
    assert_eq!(elastic_strain(&small, 2.0, 0.1, 10), elastic_strain(&small, 2.0, 0.1, 0));
}

#[test]
fn every_path_dissipates_energy_or_keeps_it_and_stays_within_the_bound_of_the_plastic_strain() {
    for (seed, lambda) in [(6, 4.0), (7, 0.0), (8, 300.0), (9, -0.9)] {
        let mut random = Random(seed);
        let (mut reached, mut moved) = (0, 0);
        for _ in 0..1000 {
            let (mut of, mut G) = (Additive { lambda, ..law(zero()) }, zero());
            for _ in 0..50 {
                let change = random.tensor(0.3);
                G = from_fn(|i, j| 0.9 * G[i][j] + change[i][j]);
                let before = of.energy(&G);
                let (after, dissipated) = of.flow(&G, YIELD, 0.5 + 0.5 * random.number(), MAXIMUM);
                moved += usize::from(after.plastic != of.plastic);
                of.plastic = after.plastic;
                let rounding = 1e-13 * (1.0 + before);
                assert!(of.energy(&G) <= before + rounding, "seed {seed}: {before} at {G:?}");
                assert!((before - of.energy(&G) - dissipated).abs() < rounding, "seed {seed}: {G:?}");
                assert!(dissipated >= 0.0 && norm(&of.plastic) <= MAXIMUM && after.strain <= MAXIMUM, "seed {seed}");
                reached += usize::from(after.strain > 0.999 * MAXIMUM);
            }
        }
        assert!(moved > 10_000 && reached > 1000, "seed {seed}: {moved} {reached}");
    }
}
