//! Iterative refinement of a solution by corrections in single precision: Wilkinson, Rounding Errors in Algebraic Processes
//! (1963).

use super::cg::Workspace;
use fem_elements::Real;
use fem_elements::vector::{norm, subtract_from};
use fem_model::simulation::Breakdown;

/// Outcome of the refinement.
pub(crate) struct Refined {
    /// Iterations of all corrections.
    pub(crate) iterations: usize,
    /// True if ‖b − A x‖ ≤ tolerance ‖b‖.
    pub(crate) converged: bool,
}

/// Corrects x until ‖b − A x‖ ≤ tolerance ‖b‖, or until a correction no longer halves the residual. `A(x, y)` sets y = A x, and
/// `correct(r, x, tolerance)` adds to x a solution of A d = r and returns its iterations; it is asked for a relative residual of `least` or more.
pub(crate) fn refine<T: Real>(
    A: impl Fn(&[[T; 3]], &mut [[T; 3]]),
    mut correct: impl FnMut(&[[T; 3]], &mut [[T; 3]], f64) -> Result<usize, Breakdown>,
    b: &[[T; 3]],
    x: &mut [[T; 3]],
    (tolerance, least): (f64, f64),
    workspace: &mut Workspace<T>,
) -> Result<Refined, Breakdown> {
    let r = &mut workspace.r;
    let target = tolerance * norm(b);
    let (mut iterations, mut before) = (0, f64::INFINITY);
    loop {
        if x.as_flattened().iter().all(|x| *x == T::default()) {
            r.copy_from_slice(b);
        } else {
            A(x, r);
            subtract_from(b, r);
        }
        let residual = norm(r);
        if !residual.is_finite() {
            return Err(Breakdown::Singular);
        }
        let converged = residual <= target;
        if converged || residual > 0.5 * before {
            return Ok(Refined { iterations, converged });
        }
        before = residual;
        match correct(r, x, (0.5 * target / residual).max(least)) {
            Ok(more) => iterations += more,
            // The correction may have reduced the residual all the same.
            Err(Breakdown::NotConverged { .. }) => {}
            Err(breakdown) => return Err(breakdown),
        }
    }
}
