//! What a scene asks of Newton's method.

use fem_scene::Projection;

/// When Newton's method ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest number of iterations in a step.
    pub max_iterations: usize,
    /// Largest change of a coordinate that the last iteration may still make, in lengths of the body.
    pub tolerance: f64,
    /// When elements are projected.
    pub projection: Projection,
    /// Largest relative residual of an iterative solver.
    pub solver_tolerance: f64,
}
