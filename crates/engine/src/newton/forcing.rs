//! How exactly an iterative solver must solve, and when its matrix is worth being assembled anew.

use super::{Factor, Iterate, Newton};
use crate::number::Real;
use fem_scene::simulation::Breakdown;

/// The most that a direction leaves of the gradient.
const ROUGHEST: f64 = 0.05;

/// What a last direction leaves, as a part of the tolerance.
const MARGIN: f64 = 0.1;

/// A direction that needs to be no better than this is found with the matrix that is there.
const ROUGH: f64 = 0.01;

/// A matrix of the step before that leaves more of an update is out of date.
const SLOW: f64 = 0.2;

impl Iterate {
    /// Estimate of what the next update would be, m.
    pub(super) fn left(&self) -> f64 {
        self.size * self.rate.unwrap_or(1.0).max(self.forcing).min(1.0)
    }

    /// What the next direction should leave, if that is to be all that is left: the update after next, as a part of the next.
    fn needed(&self, tolerance: f64) -> Option<f64> {
        let next = self.size * self.norms.0 / self.norms.1;
        (next.is_finite() && next > 0.0).then(|| MARGIN * tolerance / next)
    }

    /// Relative residual of the next direction: Eisenstat and Walker, Choosing the Forcing Terms in an Inexact Newton Method
    /// (1996), choice 2, as exact as the next iteration can make use of, and no more exact than the tolerance asks.
    pub(super) fn next_forcing(&self, tolerance: f64) -> f64 {
        let useful = 0.9 * (self.norms.0 / self.norms.1).powi(2);
        useful.max(self.needed(tolerance).unwrap_or(0.0)).min(ROUGHEST)
    }
}

impl<T: Real> Newton<T> {
    /// Iterates for the direction; false where there is none.
    pub(super) fn solve(&mut self, forcing: f64) -> bool {
        self.direction.fill([T::default(); 3]);
        match self.solver.solve(&self.values, &self.right, &mut self.direction, forcing) {
            Ok(iterations) => {
                self.wear(iterations);
                true
            }
            // What was reached leads downhill too.
            Err(Breakdown::NotConverged { .. }) => {
                self.iterations_at_first = None;
                true
            }
            Err(_) => false,
        }
    }

    /// A preconditioner of an earlier matrix is as good until solves take half as many iterations again.
    fn wear(&mut self, iterations: usize) {
        if self.is_new {
            (self.is_new, self.iterations_at_first) = (false, Some(iterations));
        } else if self.iterations_at_first.is_some_and(|first| iterations > 4 + first + first / 2) {
            self.iterations_at_first = None;
        }
    }

    /// Keeps the matrix for one rough direction more; else it is assembled anew.
    pub(super) fn judge_matrix(&mut self, at: &Iterate, tolerance: f64) {
        self.is_outworn |= at.rate.is_some_and(|rate| !(rate <= SLOW));
        if !at.needed(tolerance).is_some_and(|needed| needed >= ROUGH) {
            self.factor = Factor::Stale;
        }
    }
}
