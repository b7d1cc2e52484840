//! Corrections in single precision of a solution in double: Wilkinson, Rounding Errors in Algebraic Processes (1963).

use super::Breakdown;
use super::cg::Work;
use crate::number::Real;
use crate::vector::{norm, subtract_from};

/// How far corrections have come.
pub(super) struct Refined {
    /// Iterations of all of them.
    pub iterations: usize,
    /// Whether the residual is as small as it should be.
    pub done: bool,
}

/// A correction need not be better: the next one begins with an exact residual.
const BEST: f64 = 1e-4;

/// Corrects x until ‖b − A x‖ ≤ tolerance ‖b‖, or until a correction no longer halves that. `A(x, y)` sets y = A x, and
/// `correct(r, x, tolerance)` adds to x a solution of A d = r.
pub(super) fn refine<T: Real>(
    A: impl Fn(&[[T; 3]], &mut [[T; 3]]),
    mut correct: impl FnMut(&[[T; 3]], &mut [[T; 3]], f64) -> Result<usize, Breakdown>,
    b: &[[T; 3]],
    x: &mut [[T; 3]],
    tolerance: f64,
    work: &mut Work<T>,
) -> Result<Refined, Breakdown> {
    let r = &mut work.r;
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
        if residual <= target || residual > 0.5 * before {
            return Ok(Refined { iterations, done: residual <= target });
        }
        before = residual;
        match correct(r, x, (0.5 * target / residual).max(BEST)) {
            Ok(more) => iterations += more,
            // What it has come to is looked at all the same.
            Err(Breakdown::NotConverged { .. }) => {}
            Err(breakdown) => return Err(breakdown),
        }
    }
}
