//! Forcing terms: the relative residual of an iterative solver's direction, and the condition for a new assembly of its matrix.

use super::{Factor, Iterate, Newton};
use fem_model::simulation::Breakdown;
use fem_solvers::Real;

/// Largest relative residual of a direction.
const LARGEST: f64 = 0.05;

/// Residual of the last direction, as a part of the tolerance.
const MARGIN: f64 = 0.1;

/// A direction to this relative residual is found with the matrix of an earlier iterate.
const COARSE: f64 = 0.01;

/// A matrix of the previous step is outdated where it reduces the update by less than this factor.
const SLOW: f64 = 0.2;

/// Part of the distance over which forces change that an update must not exceed for its ratio to the one before to be a rate.
const SMALL: f64 = 0.1;

impl Iterate {
    /// Estimate of the size of the next update, m. It includes the part of the last update that an obstacle has cut off.
    ///
    /// A large update before a small one looks like fast convergence also where the small one is as large as the layer of a barrier, in
    /// which forces change: the ratio of the two counts for updates much smaller than this `scale`, m.
    pub(super) fn remaining_update(&self, scale: f64) -> f64 {
        let rate = self.rate.filter(|_| self.size <= SMALL * scale);
        let update = self.size * rate.unwrap_or(1.0).max(self.forcing).min(1.0);
        update.max(self.left_out)
    }

    /// Relative residual with which the next direction would be the last: the update after it is within the tolerance.
    fn final_forcing(&self, tolerance: f64) -> Option<f64> {
        let next = self.size * self.norms.0 / self.norms.1;
        (next.is_finite() && next > 0.0).then(|| MARGIN * tolerance / next)
    }

    /// Relative residual of the next direction: Eisenstat and Walker, Choosing the Forcing Terms in an Inexact Newton Method
    /// (1996), choice 2, and no smaller than the tolerance requires.
    pub(super) fn next_forcing(&self, tolerance: f64) -> f64 {
        let choice_2 = 0.9 * (self.norms.0 / self.norms.1).powi(2);
        choice_2.max(self.final_forcing(tolerance).unwrap_or(0.0)).min(LARGEST)
    }
}

impl<T: Real> Newton<T> {
    /// Solves for the direction iteratively; returns false if the solver breaks down.
    pub(super) fn solve_inexactly(&mut self, forcing: f64) -> bool {
        self.direction.fill([T::default(); 3]);
        match self.solver.solve(&self.values, &self.right, &mut self.direction, forcing) {
            Ok(iterations) => {
                self.review_preconditioner(iterations);
                true
            }
            // The last iterate is a descent direction too.
            Err(Breakdown::NotConverged { .. }) => {
                self.first_iterations = None;
                true
            }
            Err(_) => false,
        }
    }

    /// Keeps the preconditioner of an earlier matrix until solves take half as many iterations more.
    fn review_preconditioner(&mut self, iterations: usize) {
        if self.is_new_preconditioner {
            (self.is_new_preconditioner, self.first_iterations) = (false, Some(iterations));
        } else if self.first_iterations.is_some_and(|first| iterations > 4 + first + first / 2) {
            self.first_iterations = None;
        }
    }

    /// Keeps the matrix for one more direction if this direction may have a large residual; otherwise assembles it again.
    pub(super) fn review_matrix(&mut self, at: &Iterate, tolerance: f64) {
        self.is_matrix_outdated |= at.rate.is_some_and(|rate| !(rate <= SLOW));
        if !at.final_forcing(tolerance).is_some_and(|forcing| forcing >= COARSE) {
            self.factor = Factor::Stale;
        }
    }
}
