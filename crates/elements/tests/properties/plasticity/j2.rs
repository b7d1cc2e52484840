//! Von Mises plasticity.

use super::*;
use fem_elements::tensor::{transpose, zero};

const SHEAR: f64 = 1.5;

fn law(hardening: f64) -> J2<f64> {
    J2 { mu: SHEAR, bulk: 5.0, yield_stress: 0.2, hardening, plastic: zero(), strain: 0.0 }
}

/// The law after a step that ends with G.
fn after(law: &J2<f64>, G: &Tensor<f64>) -> (J2<f64>, f64) {
    let (Internal { plastic, strain }, dissipated) = law.flow(G);
    (J2 { plastic, strain, ..*law }, dissipated)
}

/// Kirchhoff stress P Fᵀ.
fn kirchhoff(law: &J2<f64>, G: &Tensor<f64>) -> Tensor<f64> {
    product(&law.stress(G), &transpose(&plus_identity(G)))
}

fn von_mises(tau: &Tensor<f64>) -> f64 {
    fem_output::von_mises(&nalgebra::Matrix3::from_fn(|i, j| tau[i][j]))
}

/// Displacement gradients of det F > 0.3 of random sizes.
fn gradient(random: &mut Random) -> Tensor<f64> {
    loop {
        let size = 0.25 * (1.0 + random.number());
        let G = random.tensor(size);
        if 1.0 + fem_elements::tensor::volume_change(&G).0 > 0.3 {
            return G;
        }
    }
}

#[test]
fn stress_and_consistent_tangent_are_the_derivatives_of_the_energy_of_a_step() {
    let mut random = Random(11);
    let (mut flows, mut rests) = (0, 0);
    for hardening in [0.0, 0.3, 20.0] {
        for number in 0..100 {
            let before = gradient(&mut random);
            let (law, _) = after(&law(hardening), &before);
            // A small part of the way back is elastic; most of the others flow.
            let back = before.map(|row| row.map(|entry| 0.97 * entry));
            let G = if number % 2 == 0 { back } else { gradient(&mut random) };
            let excess = law.flow(&G).0.strain - law.strain;
            // Differences do not cross the yield surface, where the tangent jumps.
            let limit = law.yield_stress + law.hardening * law.strain;
            let is_far = excess > 1e-3 || excess == 0.0 && von_mises(&kirchhoff(&law, &G)) < 0.99 * limit;
            if is_far {
                assert_consistent(&law, &G);
                flows += usize::from(excess > 0.0);
                rests += usize::from(excess == 0.0);
            }
        }
    }
    assert!(flows > 100 && rests > 20, "{flows} {rests}");
}

#[test]
fn equal_stretches_have_a_consistent_tangent() {
    for stretches in [[1.0, 1.0, 1.0], [1.2, 1.2, 0.8], [0.9, 1.3, 0.9], [1.1, 1.1, 1.1]] {
        let F = from_fn(|i, j| if i == j { stretches[i] } else { 0.0 });
        assert_consistent(&law(0.3), &minus_identity(&F));
    }
}

#[test]
fn a_rotation_of_the_body_rotates_the_stress() {
    let mut random = Random(12);
    for _ in 0..100 {
        let (law, _) = after(&law(0.3), &gradient(&mut random));
        let (G, Q) = (gradient(&mut random), random.rotation());
        assert_objective(&law, &G, &Q);
        let turned = minus_identity(&product(&Q, &plus_identity(&G)));
        let (here, there) = (law.flow(&G).0, law.flow(&turned).0);
        assert!(difference(&here.plastic, &there.plastic) < 1e-12 && (here.strain - there.strain).abs() < 1e-13);
    }
}

#[test]
fn below_the_yield_stress_it_is_henckys_law() {
    let elastic = fem_elements::materials::Hencky { mu: SHEAR, lambda: 4.0 };
    let mut random = Random(13);
    for _ in 0..50 {
        let G = random.tensor(0.02);
        assert_eq!(law(0.3).flow(&G), (Internal::default(), 0.0));
        assert!((law(0.3).energy(&G) - elastic.energy(&G)).abs() < 1e-15);
        assert!(difference(&law(0.3).stress(&G), &elastic.stress(&G)) < 1e-15);
    }
}

#[test]
fn every_path_dissipates_energy_or_keeps_it_and_its_volume_and_ends_within_the_yield_surface() {
    for (seed, hardening) in [(14, 0.0), (15, 0.3), (16, 20.0)] {
        let mut random = Random(seed);
        let mut flows = 0;
        for _ in 0..500 {
            let mut of = law(hardening);
            for _ in 0..20 {
                let G = gradient(&mut random);
                let (energy, stress) = (of.energy(&G), of.stress(&G));
                let (next, dissipated) = after(&of, &G);
                flows += usize::from(dissipated > 0.0);
                assert!(dissipated >= 0.0 && next.strain >= of.strain, "seed {seed}: {G:?}");
                // The energy of the step is the stored energy after it plus the dissipated energy.
                assert!((energy - next.energy(&G) - dissipated).abs() < 1e-12 * (1.0 + energy), "seed {seed}: {G:?}");
                assert!(difference(&stress, &next.stress(&G)) < 1e-11, "seed {seed}: {G:?}");
                let limit = next.yield_stress + next.hardening * next.strain;
                assert!(von_mises(&kirchhoff(&next, &G)) < limit * (1.0 + 1e-10), "seed {seed}: {G:?}");
                let volume = fem_elements::tensor::volume_change(&next.plastic).0;
                assert!(volume.abs() < 1e-11, "seed {seed}: {volume:e}");
                of = next;
            }
        }
        assert!(flows > 1000, "seed {seed}: {flows}");
    }
}

#[test]
fn the_return_is_the_minimum_of_stored_and_dissipated_energy() {
    let mut random = Random(17);
    for _ in 0..100 {
        let (of, _) = after(&law(0.3), &gradient(&mut random));
        let G = gradient(&mut random);
        let step = of.energy(&G);
        // A smaller or larger flow, as that of another yield stress is, costs more.
        for factor in [0.5, 0.9, 1.1, 1.5] {
            let other = J2 { yield_stress: factor * of.yield_stress, ..of };
            let (Internal { plastic, strain }, _) = other.flow(&G);
            let stored = J2 { plastic, strain, yield_stress: 1e9, ..of }.energy(&G);
            let cost = stored + of.yield_stress * (strain - of.strain);
            assert!(cost >= step - 1e-13 * (1.0 + step), "{factor}: {cost} below {step} at {G:?}");
        }
    }
}

/// The radial return of small strains: Simo and Hughes, Computational Inelasticity (1998), box 3.1, with linear isotropic hardening, in a
/// formulation of its own: strains and stresses as matrices.
struct SmallStrains {
    plastic: nalgebra::Matrix3<f64>,
    strain: f64,
}

impl SmallStrains {
    /// The stress at the end of a step with this strain.
    fn step(&mut self, of: &J2<f64>, strain: &nalgebra::Matrix3<f64>) -> nalgebra::Matrix3<f64> {
        let identity = nalgebra::Matrix3::identity();
        let elastic = strain - self.plastic;
        let deviator = 2.0 * of.mu * (elastic - identity * (elastic.trace() / 3.0));
        let pressure = identity * (of.bulk * strain.trace());
        let excess = deviator.norm() - (2.0f64 / 3.0).sqrt() * (of.yield_stress + of.hardening * self.strain);
        if excess <= 0.0 {
            return pressure + deviator;
        }
        let (normal, gamma) = (deviator / deviator.norm(), excess / (2.0 * of.mu + 2.0 / 3.0 * of.hardening));
        self.plastic += gamma * normal;
        self.strain += (2.0f64 / 3.0).sqrt() * gamma;
        pressure + deviator - 2.0 * of.mu * gamma * normal
    }
}

#[test]
fn a_path_of_small_plane_strains_has_the_stresses_of_the_small_strain_return_to_eight_digits() {
    let scale = 2e-6;
    for hardening in [0.0, 0.4] {
        let of = J2 { yield_stress: scale, ..law(hardening) };
        let mut both = [of, of];
        let mut small = SmallStrains { plastic: nalgebra::Matrix3::zeros(), strain: 0.0 };
        let (mut random, mut flows) = (Random(18), 0);
        let mut G: Tensor<f64> = zero();
        for step in 0..60 {
            let change = random.tensor(0.5 * scale);
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                G[i][j] += change[i][j];
            }
            let gradient = nalgebra::Matrix3::from_fn(|i, j| G[i][j]);
            let before = small.strain;
            let expected = small.step(&of, &(0.5 * (gradient + gradient.transpose())));
            flows += usize::from(small.strain > before);
            // Terms of first order in the strain cancel in the mean of a path and its mirror image; those of second order are left.
            let mirrored = G.map(|row| row.map(|entry| -entry));
            let ends = [after(&both[0], &G).0, after(&both[1], &mirrored).0];
            let (one, other) = (ends[0].stress(&G), ends[1].stress(&mirrored));
            let found = nalgebra::Matrix3::from_fn(|i, j| 0.5 * (one[i][j] - other[i][j]));
            let error = (found - expected).amax() / expected.amax();
            assert!(error < 1e-8, "seed 18, step {step}: {error:e}");
            let strain = 0.5 * (ends[0].strain + ends[1].strain);
            assert!((strain - small.strain).abs() < 1e-8 * (small.strain + scale), "seed 18, step {step}");
            both = ends;
        }
        assert!(flows > 15 && flows < 60, "{flows}");
    }
}
