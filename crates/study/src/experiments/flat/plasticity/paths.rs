//! Random paths of plane strain of single elements: their flow loses free energy.

use fem_engine::materials::Law;
use fem_engine::plasticity::{Additive, J2};
use fem_engine::tensor::{Tensor, from_fn, volume_change, zero};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;

/// Steps of a path.
const STEPS: usize = 5;
/// Paths that share a generator, whose seed is their number.
const BLOCK: usize = 1000;
/// Rounding error of a loss of free energy, relative to the energy.
pub const ROUNDING: f64 = 1e-12;
/// Shear modulus of both models; energies are relative to it.
const SHEAR: f64 = 1.0;

/// The outcome of many paths.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Steps of all paths.
    pub steps: usize,
    /// Steps in which the plastic strain changes.
    pub flows: usize,
    /// Smallest dissipation of a step by the model.
    pub least_dissipation: f64,
    /// Smallest loss of free energy by the flow of a step at its constant strain, less the model's dissipation, over 1 plus the energy.
    pub least_loss: f64,
}

impl Found {
    const NONE: Self = Self { steps: 0, flows: 0, least_dissipation: f64::INFINITY, least_loss: f64::INFINITY };

    fn and(self, other: Self) -> Self {
        // A NaN stays.
        let least = |a: f64, b: f64| if a <= b || a.is_nan() { a } else { b };
        Self {
            steps: self.steps + other.steps,
            flows: self.flows + other.flows,
            least_dissipation: least(self.least_dissipation, other.least_dissipation),
            least_loss: least(self.least_loss, other.least_loss),
        }
    }

    /// A step with the free energy before and after its flow, and the model's dissipation.
    fn of_step(has_flowed: bool, [before, after]: [f64; 2], dissipated: f64) -> Self {
        let loss = (before - after - dissipated) / (1.0 + before);
        Self { steps: 1, flows: usize::from(has_flowed), least_dissipation: dissipated, least_loss: loss }
    }
}

/// Von Mises plasticity with hardening. The plastic work of a step exceeds σ_y Δα by what the strain does at once, so that the loss is positive.
pub fn j2(paths: usize) -> Found {
    let start = J2 { mu: SHEAR, bulk: 2.5, yield_stress: 0.1, hardening: 0.2, plastic: zero(), strain: 0.0 };
    // Without yield the energy is the free energy.
    let free_energy = |of: &J2<f64>, G: &Tensor<f64>| J2 { yield_stress: 1e9, ..*of }.energy(G);
    all_paths(paths, start, |of, G, _| {
        let ((after, dissipated), before) = (of.flow(G), free_energy(of, G));
        let has_flowed = after.strain > of.strain;
        (of.plastic, of.strain) = (after.plastic, after.strain);
        Found::of_step(has_flowed, [before, free_energy(of, G)], dissipated)
    })
}

/// The additive model with the yield strain 0.05 and the maximum 0.6; a fraction of the excess, from 0 to 1, flows in a step.
pub fn additive(paths: usize) -> Found {
    let start = Additive { mu: SHEAR, lambda: SHEAR, plastic: zero(), is_in_plane: true };
    all_paths(paths, start, |of, G, random| {
        let ((after, dissipated), before) = (of.flow(G, 0.05, random.random(), 0.6), of.energy(G));
        let has_flowed = after.plastic != of.plastic;
        of.plastic = after.plastic;
        Found::of_step(has_flowed, [before, of.energy(G)], dissipated)
    })
}

/// Runs paths that begin with a law, on all threads; the same ones whatever their number.
fn all_paths<L: Copy + Sync>(
    paths: usize,
    start: L,
    step: impl Fn(&mut L, &Tensor<f64>, &mut ChaCha8Rng) -> Found + Sync,
) -> Found {
    let block = |number: usize| {
        let mut random = ChaCha8Rng::seed_from_u64(number as u64);
        let mut found = Found::NONE;
        for _ in 0..BLOCK.min(paths - BLOCK * number) {
            let (mut law, mut G) = (start, zero());
            for _ in 0..STEPS {
                G = next(&G, &mut random);
                found = found.and(step(&mut law, &G, &mut random));
            }
        }
        found
    };
    (0..paths.div_ceil(BLOCK)).into_par_iter().map(block).reduce(|| Found::NONE, Found::and)
}

/// A displacement gradient near another one, with det F > 0.3.
fn next(G: &Tensor<f64>, random: &mut ChaCha8Rng) -> Tensor<f64> {
    loop {
        let in_plane = |i: usize, j: usize| i < 2 && j < 2;
        let mut entry =
            |i: usize, j: usize| 0.8 * G[i][j] + if in_plane(i, j) { random.random_range(-0.3..0.3) } else { 0.0 };
        let G = from_fn(&mut entry);
        if 1.0 + volume_change(&G).0 > 0.3 {
            return G;
        }
    }
}
