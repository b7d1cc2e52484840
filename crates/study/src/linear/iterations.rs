//! Iterations for linear systems, for teaching: Shewchuk, An Introduction to the Conjugate Gradient Method Without the Agonizing Pain (1994).
//! Each solves A x = b from the given x and returns the number of iterations; on failure x is the last iterate. `observe` sees every iterate.

use fem_engine::solvers::krylov::{LinearSystem, Progress, max_iterations};
use fem_engine::vector::{axpy, dot, norm, subtract_from};
use fem_model::simulation::Breakdown;

/// Iterations after which the residual is computed from its definition, and not by recurrence.
const REFRESH: usize = 50;

/// The largest number of iterations: so many more than conjugate gradients need as the root of the condition number.
const MAX_ITERATIONS: usize = 100_000;

/// Steepest descent: Cauchy (1847); Shewchuk, §4, equations 10 to 13. In each iteration x moves along the residual to the minimum of
/// ½ xᵀ A x − bᵀ x on that line; the energy norm of the error falls at least by the factor (κ − 1)/(κ + 1).
pub(super) fn steepest_descent(
    system: LinearSystem<f64, impl Fn(&[[f64; 3]], &mut [[f64; 3]]), impl Fn() -> f64>,
    x: &mut [[f64; 3]],
    observe: &mut dyn FnMut(&[[f64; 3]]),
) -> Result<usize, Breakdown> {
    let LinearSystem { A, largest_entry, b, tolerance } = system;
    let (mut r, mut q) = (b.to_vec(), b.to_vec());
    let b_norm = norm(b);
    if b_norm == 0.0 {
        x.fill([0.0; 3]);
        return Ok(0);
    }
    let mut progress = Progress::new(b_norm, tolerance);
    let mut is_small = true;
    observe(x);
    for iterations in 0..=MAX_ITERATIONS {
        if is_small || iterations % REFRESH == 0 {
            A(x, &mut r);
            subtract_from(b, &mut r);
        }
        // If the recurrence appears converged too early, the iteration continues from the true residual.
        if is_small && progress.true_residual(norm(&r), || f64::EPSILON * largest_entry() * norm(x))? {
            return Ok(iterations);
        }
        A(&r, &mut q);
        let rr = dot(&r, &r);
        let alpha = rr / progress.curvature(dot(&r, &q), rr)?;
        axpy(alpha, &r, x);
        axpy(-alpha, &q, &mut r);
        observe(x);
        // The error falls in every iteration; the residual may grow for many of them.
        let residual = norm(&r);
        if !residual.is_finite() {
            return Err(Breakdown::Singular);
        }
        is_small = residual <= tolerance * b_norm;
    }
    Err(Breakdown::NotConverged { residual: norm(&r) / b_norm })
}

/// A kept direction p.
struct Direction {
    p: Vec<[f64; 3]>,
    /// A p
    q: Vec<[f64; 3]>,
    /// p·A p
    curvature: f64,
}

/// Conjugate directions by Gram–Schmidt's method: Shewchuk, §7.2, equations 36 and 37, applied to the residuals. Every direction is kept, and every
/// residual made conjugate to all of them; conjugate gradients need the last one alone, and have the same iterates but for rounding errors.
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
