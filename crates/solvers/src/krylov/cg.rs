//! Preconditioned conjugate gradients: Hestenes and Stiefel, Methods of Conjugate Gradients for Solving Linear Systems (1952).

use super::progress::{LinearSystem, Progress, max_iterations};
use fem_elements::Real;
use fem_elements::vector::{axpy, dot, norm, subtract_from, xpby};
use fem_model::simulation::Breakdown;

/// Vectors of the iteration: the residual r, the preconditioned residual z, the direction p and q = A p.
pub struct Workspace<T> {
    pub(super) r: Vec<[T; 3]>,
    z: Vec<[T; 3]>,
    p: Vec<[T; 3]>,
    pub(super) q: Vec<[T; 3]>,
}

impl<T: Real> Workspace<T> {
    /// Allocates them for so many block rows.
    pub fn new(rows: usize) -> Self {
        let zeros = || vec![[T::default(); 3]; rows];
        Self { r: zeros(), z: zeros(), p: zeros(), q: zeros() }
    }

    pub(crate) fn bytes(&self) -> usize {
        4 * size_of_val(self.r.as_slice())
    }
}

/// Solves A x = b from the given x, to ‖b − A x‖ ≤ tolerance ‖b‖. Returns the number of iterations; on failure x is the last
/// iterate.
///
/// `P(r, z)` sets z = P⁻¹ r. The iteration updates the residual by recurrence. Before it returns as converged, it computes the residual from
/// its definition and restarts if that is too large. `observe` sees every iterate.
///
/// # Errors
/// The matrix is not positive definite, or the tolerance is out of reach.
pub fn conjugate_gradients<T: Real>(
    system: LinearSystem<T, impl Fn(&[[T; 3]], &mut [[T; 3]]), impl Fn() -> f64>,
    mut P: impl FnMut(&[[T; 3]], &mut [[T; 3]]),
    x: &mut [[T; 3]],
    workspace: &mut Workspace<T>,
    observe: &mut dyn FnMut(&[[T; 3]]),
) -> Result<usize, Breakdown> {
    let LinearSystem { A, largest_entry, b, tolerance } = system;
    let Workspace { r, z, p, q } = workspace;
    let b_norm = norm(b);
    if b_norm == 0.0 {
        x.fill([T::default(); 3]);
        return Ok(0);
    }
    let mut progress = Progress::new(b_norm, tolerance);
    let mut state = State::Restart;
    observe(x);
    for iterations in 0..=max_iterations(b.len()) {
        if let State::Restart = state {
            A(x, r);
            subtract_from(b, r);
            if progress.true_residual(norm(r), || T::EPSILON.as_f64() * largest_entry() * norm(x))? {
                return Ok(iterations);
            }
            P(r, z);
            p.copy_from_slice(z);
            state = State::Continue { rz: positive(dot(r, z))? };
        }
        let State::Continue { rz } = state else { continue };
        A(p, q);
        let alpha = rz / progress.curvature(dot(p, q), dot(p, p))?;
        axpy(alpha, p, x);
        axpy(-alpha, q, r);
        observe(x);
        state = if progress.residual(norm(r))? {
            State::Restart
        } else {
            P(r, z);
            let next = positive(dot(r, z))?;
            xpby(z, next / rz, p);
            State::Continue { rz: next }
        };
    }
    Err(progress.failure())
}

/// State between two iterations.
#[derive(Clone, Copy)]
enum State {
    /// With the residual by its definition and the preconditioned residual as direction.
    Restart,
    /// With the residual and the direction of the recurrence; `rz` is r·z.
    Continue { rz: f64 },
}

/// Refuses an r·P⁻¹r that is not positive, for r ≠ 0.
fn positive(rz: f64) -> Result<f64, Breakdown> {
    match rz {
        _ if !rz.is_finite() => Err(Breakdown::Singular),
        _ if rz <= 0.0 => Err(Breakdown::NotPositiveDefinite),
        _ => Ok(rz),
    }
}
