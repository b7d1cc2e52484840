//! A linear system, and how far an iteration for it has come.

use fem_model::simulation::Breakdown;

/// A curvature below this multiple of round-off in the largest curvature so far counts as zero.
const ZERO_CURVATURE: f64 = 8.0;

/// The rounded exact solution has a residual of up to this multiple of round-off in ‖A‖ ‖x‖.
const ATTAINABLE: f64 = 64.0;

/// Iterations without a smaller residual after which the solve fails.
const MAX_STAGNATION: usize = 1000;

/// The largest number of iterations of one solve, as a multiple of the number of unknowns and in total.
const MAX_ITERATIONS: (usize, usize) = (4, 20_000);

/// A x = b, to be solved to ‖b − A x‖ ≤ tolerance ‖b‖.
pub struct LinearSystem<'a, T, A, L> {
    /// `A(x, y)` sets y = A x.
    pub A: A,
    /// The largest entry of A.
    pub largest_entry: L,
    /// The right-hand side.
    pub b: &'a [[T; 3]],
    /// Relative residual.
    pub tolerance: f64,
}

/// The largest number of iterations of a solve with so many block rows.
pub fn max_iterations(rows: usize) -> usize {
    (MAX_ITERATIONS.0 * 3 * rows).min(MAX_ITERATIONS.1)
}

/// Convergence of the iteration.
pub struct Progress {
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
    /// That of an iteration whose right-hand side has the norm `b`.
    pub fn new(b: f64, tolerance: f64) -> Self {
        let infinite = f64::INFINITY;
        Self { b, target: tolerance * b, best: infinite, stagnation: 0, last_true: infinite, largest_curvature: 0.0 }
    }

    /// Returns whether the norm of a residual that was computed from its definition is small enough. If it is not below half
    /// of the last one, either round-off has been reached (`round_off()` is that of A x) or the iteration fails.
    ///
    /// # Errors
    /// The residual is not finite, or neither smaller nor rounding.
    pub fn true_residual(&mut self, residual: f64, round_off: impl Fn() -> f64) -> Result<bool, Breakdown> {
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
    ///
    /// # Errors
    /// It is not finite, or has not become smaller for a thousand iterations.
    pub fn residual(&mut self, residual: f64) -> Result<bool, Breakdown> {
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
    ///
    /// # Errors
    /// It does not: the matrix is not positive definite, or singular.
    pub fn curvature(&mut self, pq: f64, pp: f64) -> Result<f64, Breakdown> {
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

    /// The error of an iteration that has taken all of its iterations.
    pub fn failure(&self) -> Breakdown {
        Breakdown::NotConverged { residual: self.best / self.b }
    }
}
