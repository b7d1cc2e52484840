//! The direction of an iteration: a solve with the Hessian, or with a kept factor and the pairs of limited-memory BFGS.

use super::{Iterate, Newton};
use fem_elements::vector::dot;
use fem_solvers::Real;

impl<T: Real> Newton<T> {
    /// Solves for the direction, and returns the directional derivative; it is negative in a descent direction and NaN where the solve
    /// fails.
    pub(super) fn find_direction(&mut self, at: &mut Iterate, tolerance: f64) -> f64 {
        for (right, g) in self.right.iter_mut().zip(&self.gradient) {
            *right = g.map(|g| -g);
        }
        let solved = if self.solver.is_iterative() {
            let least = self.limits.solver_tolerance.max(self.solver.smallest_tolerance());
            at.forcing = at.next_forcing(tolerance).max(least);
            self.solve_inexactly(at.forcing)
        } else {
            let Self { solver, lbfgs, direction, right, .. } = self;
            direction.copy_from_slice(right);
            lbfgs.apply(direction, |x| {
                right.copy_from_slice(x);
                solver.apply(right, x);
            });
            true
        };
        if solved { dot(&self.gradient, &self.direction) } else { f64::NAN }
    }
}
