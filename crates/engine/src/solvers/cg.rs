//! Conjugate gradients, Hestenes and Stiefel, Methods of Conjugate Gradients for Solving Linear Systems (1952), with a
//! preconditioner or with none.

use super::{Breakdown, Solved};
use crate::number::Real;
use crate::vector::{axpy, dot, norm, subtract_from, xpby};

/// Vectors that an iteration needs; kept from one solve to the next.
pub(super) struct Work<T> {
    pub(super) r: Vec<[T; 3]>,
    z: Vec<[T; 3]>,
    p: Vec<[T; 3]>,
    q: Vec<[T; 3]>,
}

/// A curvature this many roundings small, against the largest seen, is none.
const ROUNDINGS: f64 = 8.0;

/// A residual of so many roundings of ‖A‖ ‖x‖ is what the exact solution has too, once it is rounded.
const UNAVOIDABLE: f64 = 64.0;

/// Iterations without a smaller residual after which there is no hope.
const PATIENCE: usize = 1000;

/// The most iterations of one solve, as a multiple of the unknowns and in all.
const MOST: (usize, usize) = (4, 20_000);

impl<T: Real> Work<T> {
    pub(super) fn new(rows: usize) -> Self {
        let zeros = || vec![[T::default(); 3]; rows];
        Self { r: zeros(), z: zeros(), p: zeros(), q: zeros() }
    }

    pub(super) fn bytes(&self) -> usize {
        4 * size_of_val(self.r.as_slice())
    }
}

/// Solves A x = b from the x that is given, to ‖b − A x‖ ≤ tolerance ‖b‖; x is the last iterate whether or not it succeeds.
///
/// `A(x, y)` sets y = A x and `P(r, z)` sets z = P⁻¹ r; `size()` is that of A's largest entry. The residual is that of the recurrence, and is computed anew before
/// the iteration believes that it is done.
pub(super) fn conjugate_gradients<T: Real>(
    A: impl Fn(&[[T; 3]], &mut [[T; 3]]),
    mut P: impl FnMut(&[[T; 3]], &mut [[T; 3]]),
    size: impl Fn() -> f64,
    b: &[[T; 3]],
    x: &mut [[T; 3]],
    tolerance: f64,
    work: &mut Work<T>,
) -> Result<Solved, Breakdown> {
    let Work { r, z, p, q } = work;
    let b_norm = norm(b);
    if b_norm == 0.0 {
        x.fill([T::default(); 3]);
        return Ok(Solved::default());
    }
    let mut progress = Progress::new(b_norm, tolerance);
    let mut state = Start::Fresh;
    let most = (MOST.0 * 3 * b.len()).min(MOST.1);
    for iterations in 0..=most {
        if let Start::Fresh = state {
            A(x, r);
            subtract_from(b, r);
            if progress.true_residual(norm(r), || T::EPSILON.as_f64() * size() * norm(x))? {
                return Ok(Solved { iterations });
            }
            P(r, z);
            p.copy_from_slice(z);
            state = Start::Along { rz: positive(dot(r, z))? };
        }
        let Start::Along { rz } = state else { continue };
        A(p, q);
        let alpha = rz / progress.curvature(dot(p, q), dot(p, p))?;
        axpy(alpha, p, x);
        axpy(-alpha, q, r);
        state = if progress.residual(norm(r))? {
            Start::Fresh
        } else {
            P(r, z);
            let next = positive(dot(r, z))?;
            xpby(z, next / rz, p);
            Start::Along { rz: next }
        };
    }
    Err(Breakdown::NotConverged { residual: progress.best / b_norm })
}

/// Where an iteration goes on from.
#[derive(Clone, Copy)]
enum Start {
    /// A residual computed anew, and its own direction.
    Fresh,
    /// The next direction of the recurrence; r·z of its residual.
    Along { rz: f64 },
}

/// r·P⁻¹r of a residual that is not 0.
fn positive(rz: f64) -> Result<f64, Breakdown> {
    match rz {
        _ if !rz.is_finite() => Err(Breakdown::Singular),
        _ if rz <= 0.0 => Err(Breakdown::NotPositiveDefinite),
        _ => Ok(rz),
    }
}

/// Whether the iteration gets anywhere.
struct Progress {
    b: f64,
    target: f64,
    best: f64,
    /// Iterations since `best`.
    since: usize,
    /// The last residual that was computed anew.
    last_true: f64,
    largest_curvature: f64,
}

impl Progress {
    fn new(b: f64, tolerance: f64) -> Self {
        let infinite = f64::INFINITY;
        Self { b, target: tolerance * b, best: infinite, since: 0, last_true: infinite, largest_curvature: 0.0 }
    }

    /// Whether a residual computed anew is small enough. Where it is no smaller than half of the last one it is either what
    /// round-off leaves, `rounding` being that of the solution, or an error.
    fn true_residual(&mut self, residual: f64, rounding: impl Fn() -> f64) -> Result<bool, Breakdown> {
        if !residual.is_finite() {
            return Err(Breakdown::Singular);
        }
        if residual <= self.target {
            return Ok(true);
        }
        if residual > 0.5 * self.last_true {
            if residual <= UNAVOIDABLE * rounding() {
                return Ok(true);
            }
            return Err(Breakdown::NotConverged { residual: residual / self.b });
        }
        self.last_true = residual;
        (self.best, self.since) = (residual, 0);
        Ok(false)
    }

    /// Whether the residual of the recurrence is small enough.
    fn residual(&mut self, residual: f64) -> Result<bool, Breakdown> {
        if !residual.is_finite() {
            return Err(Breakdown::Singular);
        }
        self.since += 1;
        if residual < self.best {
            (self.best, self.since) = (residual, 0);
        }
        if self.since > PATIENCE {
            return Err(Breakdown::NotConverged { residual: self.best / self.b });
        }
        Ok(residual <= self.target)
    }

    /// p·Ap, where it is positive beyond doubt.
    fn curvature(&mut self, pq: f64, pp: f64) -> Result<f64, Breakdown> {
        let curvature = pq / pp;
        if !curvature.is_finite() {
            return Err(Breakdown::Singular);
        }
        self.largest_curvature = self.largest_curvature.max(curvature.abs());
        let doubt = ROUNDINGS * f64::EPSILON * self.largest_curvature;
        match curvature {
            _ if curvature < -doubt => Err(Breakdown::NotPositiveDefinite),
            _ if curvature <= doubt => Err(Breakdown::Singular),
            _ => Ok(pq),
        }
    }
}
