//! Termination of Newton's method.

use fem_model::Projection;

/// Stopping criteria of Newton's method, and how it assembles its Hessian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonLimits {
    /// Largest number of iterations in a step.
    pub max_iterations: usize,
    /// Largest change of a coordinate in the last iteration, as a part of the body's length.
    pub tolerance: f64,
    /// Projection of element Hessians to positive semi-definite ones.
    pub projection: Projection,
    /// Largest relative residual of an iterative linear solver.
    pub solver_tolerance: f64,
}
