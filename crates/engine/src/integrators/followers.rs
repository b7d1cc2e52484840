//! Follower loads in implicit methods: fixed while Newton's method runs, evaluated again until they no longer change.

use fem_model::simulation::{Cause, Counters};

use super::Convergence;
use crate::model::system::System;
use crate::newton::incremental_potential::{Increment, IncrementalPotential};
use crate::newton::{Newton, Start};
use fem_elements::vector::{max_norm, triple};
use fem_solvers::Real;

/// Largest number of evaluations in a step.
const MOST: usize = 100;

/// The gradient of the follower loads, kept fixed.
#[derive(Clone, Debug)]
pub struct Followers<T> {
    /// N; empty without follower loads, as are the other two.
    gradient: Vec<[T; 3]>,
    previous: Vec<[T; 3]>,
    /// Displacements at which they are evaluated, m.
    u: Vec<[T; 3]>,
}

impl<T: Real> Followers<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let nodes = if system.forces.has_followers() { system.nodes() } else { 0 };
        let zero = || vec![[T::default(); 3]; nodes];
        Self { gradient: zero(), previous: zero(), u: zero() }
    }

    /// The incremental potential of a step with these follower loads.
    pub fn potential<'a>(&'a self, system: &'a System<T>, increment: Increment<'a, T>) -> IncrementalPotential<'a, T> {
        IncrementalPotential { system, increment, followers: &self.gradient }
    }

    /// Evaluates the follower loads on the surface at the end of the increment w.
    pub fn evaluate(&mut self, system: &System<T>, increment: &Increment<T>, w: &[[T; 3]]) {
        if self.gradient.is_empty() {
            return;
        }
        for (u, (start, w)) in self.u.iter_mut().zip(increment.start.iter().zip(w)) {
            *u = triple(|i| start[i] + w[i]);
        }
        self.gradient.fill([T::default(); 3]);
        system.add_follower_gradient(&self.u, increment.end, &mut self.gradient);
    }

    /// Moves w, which `start` was evaluated at, to the minimum of the incremental potential, as often as the follower loads change
    /// with it.
    pub fn minimize(
        &mut self,
        newton: &mut Newton<T>,
        system: &System<T>,
        increment: Increment<T>,
        mut start: Start,
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let mut before = f64::INFINITY;
        for _ in 0..MOST {
            let outcome = newton.minimize(&self.potential(system, increment), start, w, counters)?;
            if self.gradient.is_empty() || outcome == Convergence::NotConverged {
                return Ok(outcome);
            }
            let change = self.evaluate_again(system, &increment, w);
            // Rounding errors may change the last digits in every iteration.
            if change <= newton.limits().tolerance || (change < 1e-8 && change >= before) {
                return Ok(Convergence::Converged);
            }
            before = change;
            start = newton.start(&self.potential(system, increment), w, counters).ok_or(Cause::Overflow)?;
        }
        Ok(Convergence::NotConverged)
    }

    /// Evaluates the follower loads again, and returns their largest change relative to the largest of them.
    fn evaluate_again(&mut self, system: &System<T>, increment: &Increment<T>, w: &[[T; 3]]) -> f64 {
        self.previous.copy_from_slice(&self.gradient);
        self.evaluate(system, increment, w);
        let pairs = self.previous.as_flattened().iter().zip(self.gradient.as_flattened());
        let change = pairs.map(|(a, b)| (b.as_f64() - a.as_f64()).abs()).fold(0.0, f64::max);
        let size = max_norm(&self.gradient);
        if size > 0.0 { change / size } else { 0.0 }
    }
}
