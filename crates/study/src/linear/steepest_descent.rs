//! Steepest descent, for teaching: Cauchy (1847); Shewchuk, An Introduction to the Conjugate Gradient Method Without the Agonizing Pain
//! (1994), §4, equations 10 to 13. In each iteration x moves along the residual to the minimum of ½ xᵀ A x − bᵀ x on that line; the energy
//! norm of the error falls at least by the factor (κ − 1)/(κ + 1).

use fem_engine::solvers::krylov::{LinearSystem, Progress};
use fem_engine::vector::{axpy, dot, norm, subtract_from};
use fem_model::simulation::Breakdown;

/// Iterations after which the residual is computed from its definition, and not by recurrence.
const REFRESH: usize = 50;

/// The largest number of iterations: so many more than conjugate gradients need as the root of the condition number.
const MAX_ITERATIONS: usize = 100_000;

/// Solves A x = b from the given x. Returns the number of iterations; on failure x is the last iterate. `observe` sees every iterate.
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
