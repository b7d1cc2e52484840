//! Preconditioned conjugate gradients: Hestenes and Stiefel, Methods of Conjugate Gradients for Solving Linear Systems (1952).

use crate::number::Real;
use crate::vector::{axpy, dot, norm, subtract_from, xpby};
use fem_scene::simulation::Breakdown;

/// Vectors of the iteration: the residual r, the preconditioned residual z, the direction p and q = A p.
pub(crate) struct Workspace<T> {
    pub(super) r: Vec<[T; 3]>,
    z: Vec<[T; 3]>,
    p: Vec<[T; 3]>,
    q: Vec<[T; 3]>,
}

/// A curvature below this multiple of round-off in the largest curvature so far counts as zero.
const ZERO_CURVATURE: f64 = 8.0;

/// The rounded exact solution has a residual of up to this multiple of round-off in ‖A‖ ‖x‖.
const ATTAINABLE: f64 = 64.0;

/// Iterations without a smaller residual after which the solve fails.
const MAX_STAGNATION: usize = 1000;

/// The largest number of iterations of one solve, as a multiple of the number of unknowns and in total.
const MAX_ITERATIONS: (usize, usize) = (4, 20_000);

impl<T: Real> Workspace<T> {
    pub(crate) fn new(rows: usize) -> Self {
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
/// `A(x, y)` sets y = A x, `P(r, z)` sets z = P⁻¹ r, and `largest_entry()` is that of A. The iteration updates the residual by
/// recurrence. Before it returns as converged, it computes the residual from its definition and restarts if that is too large.
pub(crate) fn conjugate_gradients<T: Real>(
    A: impl Fn(&[[T; 3]], &mut [[T; 3]]),
    mut P: impl FnMut(&[[T; 3]], &mut [[T; 3]]),
    largest_entry: impl Fn() -> f64,
    b: &[[T; 3]],
    x: &mut [[T; 3]],
    tolerance: f64,
    workspace: &mut Workspace<T>,
) -> Result<usize, Breakdown> {
    let Workspace { r, z, p, q } = workspace;
    let b_norm = norm(b);
    if b_norm == 0.0 {
        x.fill([T::default(); 3]);
        return Ok(0);
    }
    let mut progress = Progress::new(b_norm, tolerance);
    let mut state = State::Restart;
    let max_iterations = (MAX_ITERATIONS.0 * 3 * b.len()).min(MAX_ITERATIONS.1);
    for iterations in 0..=max_iterations {
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
        state = if progress.residual(norm(r))? {
            State::Restart
        } else {
            P(r, z);
            let next = positive(dot(r, z))?;
            xpby(z, next / rz, p);
            State::Continue { rz: next }
        };
    }
    Err(Breakdown::NotConverged { residual: progress.best / b_norm })
}

/// How the next iteration begins.
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

/// Convergence of the iteration.
struct Progress {
    /// ‖b‖.
    b: f64,
    /// tolerance ‖b‖.
    target: f64,
    /// Smallest norm of a residual since the last restart.
    best: f64,
    /// Iterations since the smallest residual.
    stagnation: usize,
    /// Norm of the last residual that was computed from its definition.
    last_true: f64,
    largest_curvature: f64,
}

impl Progress {
    fn new(b: f64, tolerance: f64) -> Self {
        let infinite = f64::INFINITY;
        Self { b, target: tolerance * b, best: infinite, stagnation: 0, last_true: infinite, largest_curvature: 0.0 }
    }

    /// Returns whether the norm of a residual that was computed from its definition is small enough. If it is not below half
    /// of the last one, either round-off has been reached (`round_off()` is that of A x) or the iteration fails.
    fn true_residual(&mut self, residual: f64, round_off: impl Fn() -> f64) -> Result<bool, Breakdown> {
        if !residual.is_finite() {
            return Err(Breakdown::Singular);
        }
        if residual <= self.target {
            return Ok(true);
        }
        if residual > 0.5 * self.last_true {
            if residual <= ATTAINABLE * round_off() {
                return Ok(true);
            }
            return Err(Breakdown::NotConverged { residual: residual / self.b });
        }
        self.last_true = residual;
        (self.best, self.stagnation) = (residual, 0);
        Ok(false)
    }

    /// Returns whether the norm of the recurrence's residual is small enough.
    fn residual(&mut self, residual: f64) -> Result<bool, Breakdown> {
        if !residual.is_finite() {
            return Err(Breakdown::Singular);
        }
        self.stagnation += 1;
        if residual < self.best {
            (self.best, self.stagnation) = (residual, 0);
        }
        if self.stagnation > MAX_STAGNATION {
            return Err(Breakdown::NotConverged { residual: self.best / self.b });
        }
        Ok(residual <= self.target)
    }

    /// Returns p·Ap if it exceeds round-off.
    fn curvature(&mut self, pq: f64, pp: f64) -> Result<f64, Breakdown> {
        let curvature = pq / pp;
        if !curvature.is_finite() {
            return Err(Breakdown::Singular);
        }
        self.largest_curvature = self.largest_curvature.max(curvature.abs());
        let round_off = ZERO_CURVATURE * f64::EPSILON * self.largest_curvature;
        match curvature {
            _ if curvature < -round_off => Err(Breakdown::NotPositiveDefinite),
            _ if curvature <= round_off => Err(Breakdown::Singular),
            _ => Ok(pq),
        }
    }
}
