//! Conjugate directions by Gram–Schmidt's method, for teaching: Shewchuk, An Introduction to the Conjugate Gradient Method Without the Agonizing
//! Pain (1994), §7.2, equations 36 and 37, applied to the residuals. Every direction is kept, and every residual made conjugate to all of
//! them; conjugate gradients need the last one alone, and have the same iterates but for rounding errors.

use fem_engine::solvers::krylov::{LinearSystem, Progress, max_iterations};
use fem_engine::vector::{axpy, dot, norm, subtract_from};
use fem_model::simulation::Breakdown;

/// A kept direction p.
struct Direction {
    p: Vec<[f64; 3]>,
    /// A p
    q: Vec<[f64; 3]>,
    /// p·A p
    curvature: f64,
}

/// Solves A x = b from the given x. Returns the number of iterations; on failure x is the last iterate. `observe` sees every iterate.
pub(super) fn conjugate_directions(
    system: LinearSystem<f64, impl Fn(&[[f64; 3]], &mut [[f64; 3]]), impl Fn() -> f64>,
    x: &mut [[f64; 3]],
    observe: &mut dyn FnMut(&[[f64; 3]]),
) -> Result<usize, Breakdown> {
    let LinearSystem { A, largest_entry, b, tolerance } = system;
    let (mut r, mut p, mut q) = (b.to_vec(), b.to_vec(), b.to_vec());
    let b_norm = norm(b);
    if b_norm == 0.0 {
        x.fill([0.0; 3]);
        return Ok(0);
    }
    let mut progress = Progress::new(b_norm, tolerance);
    let mut kept: Vec<Direction> = Vec::new();
    let mut is_small = true;
    observe(x);
    for iterations in 0..=max_iterations(b.len()) {
        // As many directions as unknowns are a basis: the remaining residual is rounding error, and the directions are computed anew
        // for it.
        if kept.len() == 3 * b.len() {
            (kept, is_small) = (Vec::new(), true);
        }
        if is_small {
            A(x, &mut r);
            subtract_from(b, &mut r);
            if progress.true_residual(norm(&r), || f64::EPSILON * largest_entry() * norm(x))? {
                return Ok(iterations);
            }
        }
        p.copy_from_slice(&r);
        for Direction { p: kept, q, curvature } in &kept {
            axpy(-dot(&r, q) / curvature, kept, &mut p);
        }
        A(&p, &mut q);
        let curvature = progress.curvature(dot(&p, &q), dot(&p, &p))?;
        let alpha = dot(&p, &r) / curvature;
        axpy(alpha, &p, x);
        axpy(-alpha, &q, &mut r);
        observe(x);
        is_small = progress.residual(norm(&r))?;
        kept.push(Direction { p: p.clone(), q: q.clone(), curvature });
    }
    Err(progress.failure())
}
