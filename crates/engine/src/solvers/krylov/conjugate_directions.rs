//! Conjugate directions by Gram–Schmidt's method, for teaching: Shewchuk, An Introduction to the Conjugate Gradient Method Without the Agonizing
//! Pain (1994), §7.2, equations 36 and 37, applied to the residuals. Every direction is kept, and every residual made conjugate to all of
//! them; conjugate gradients need the last one alone, and have the same iterates but for rounding errors.

use super::cg::Workspace;
use super::progress::{LinearSystem, Progress, max_iterations};
use fem_elements::Real;
use fem_elements::vector::{axpy, dot, norm, subtract_from};
use fem_model::simulation::Breakdown;

/// A kept direction p.
struct Direction<T> {
    p: Vec<[T; 3]>,
    /// A p
    q: Vec<[T; 3]>,
    /// p·A p
    curvature: f64,
}

/// Solves A x = b from the given x. Returns the number of iterations; on failure x is the last iterate. `observe` sees every iterate.
pub(crate) fn conjugate_directions<T: Real>(
    system: LinearSystem<T, impl Fn(&[[T; 3]], &mut [[T; 3]]), impl Fn() -> f64>,
    x: &mut [[T; 3]],
    workspace: &mut Workspace<T>,
    observe: &mut dyn FnMut(&[[T; 3]]),
) -> Result<usize, Breakdown> {
    let LinearSystem { A, largest_entry, b, tolerance } = system;
    let Workspace { r, p, q, .. } = workspace;
    let b_norm = norm(b);
    if b_norm == 0.0 {
        x.fill([T::default(); 3]);
        return Ok(0);
    }
    let mut progress = Progress::new(b_norm, tolerance);
    let mut kept: Vec<Direction<T>> = Vec::new();
    let mut is_small = true;
    observe(x);
    for iterations in 0..=max_iterations(b.len()) {
        // As many directions as unknowns are a basis: the remaining residual is rounding error, and the directions are computed anew
        // for it.
        if kept.len() == 3 * b.len() {
            (kept, is_small) = (Vec::new(), true);
        }
        if is_small {
            A(x, r);
            subtract_from(b, r);
            if progress.true_residual(norm(r), || T::EPSILON.as_f64() * largest_entry() * norm(x))? {
                return Ok(iterations);
            }
        }
        p.copy_from_slice(r);
        for Direction { p: kept, q, curvature } in &kept {
            axpy(-dot(r, q) / curvature, kept, p);
        }
        A(p, q);
        let curvature = progress.curvature(dot(p, q), dot(p, p))?;
        let alpha = dot(p, r) / curvature;
        axpy(alpha, p, x);
        axpy(-alpha, q, r);
        observe(x);
        is_small = progress.residual(norm(r))?;
        kept.push(Direction { p: p.clone(), q: q.clone(), curvature });
    }
    Err(progress.failure())
}
