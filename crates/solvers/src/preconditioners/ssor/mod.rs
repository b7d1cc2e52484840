//! Conjugate gradients preconditioned by SSOR, a forward and a backward Gauss–Seidel sweep, with Eisenstat's trick: an
//! iteration takes the two sweeps and no product with the matrix. Eisenstat, Efficient Implementation of a Class of
//! Preconditioned Conjugate Gradient Methods (1981). The iteration runs in single precision, inside an iterative refinement.
//!
//! With A = L + D + Lᵀ, the preconditioner is (L + W) W⁻¹ (W + Lᵀ), where W = G Gᵀ is D minus a fraction of the change that an
//! incomplete factorisation would make to the diagonal blocks. Scaled by G, the matrix is L̃ + K + 2 + L̃ᵀ with L̃ = G⁻¹ L G⁻ᵀ
//! and K = G⁻¹ D G⁻ᵀ − 2, and the preconditioner is (L̃ + 1)(1 + L̃ᵀ). It reduces oscillating errors well and smooth errors
//! badly, so the inverse of the matrix on a coarse grid is added.
//!
//! Threads sweep over the parts of the matrix that are not coupled with each other, side by side.

mod advance;
mod scaled;
mod shares;
mod sweeps;

use super::coarse::{Coarse, Row};
use super::single_precision_scale;
use crate::parts::Part;
use crate::{ApproximateInverse, Memory};
use advance::Advance;
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};
use fem_elements::vector::norm;
use fem_model::simulation::{Breakdown, History};
use scaled::Scaled;
use shares::Shares;
use sweeps::{Start, Sweeps};

/// The largest number of iterations of one correction.
const MAX_ITERATIONS: usize = 2000;

/// Iterations without a smaller residual after which single precision is exhausted.
const MAX_STAGNATION: usize = 50;

/// Round-off in a curvature: the largest eigenvalue of the preconditioned matrix is about 1.
const ROUND_OFF: f64 = 1e-5;

/// Rows whose terms are summed in single precision before they are added to a sum in double.
const CHUNK: usize = 64;

/// Rows of two vectors together.
type Pair = [Row; 2];

/// The preconditioned matrix, and the vectors of the iteration.
pub(crate) struct Ssor {
    parts: Part,
    matrix: Scaled,
    coarse: Coarse,
    /// Restriction of residuals to the coarse grid.
    shares: Shares,
    x: Vec<Row>,
    r: Vec<Row>,
    p: Vec<Row>,
    /// Results of the sweeps for the direction: s of the forward sweep, t of the backward sweep.
    st: Vec<Pair>,
    /// Sums of the backward sweep for rows that it has not reached.
    sums: Vec<Pair>,
}

impl Ssor {
    /// Takes the lower half of a pattern, which may store all blocks, and the undeformed positions of its nodes, m.
    pub(crate) fn new(pattern: &Pattern, rest: &[[f64; 3]]) -> Self {
        let (rows, matrix) = (pattern.rows(), Scaled::new(pattern));
        let parts = Part::new(rows, |row| &matrix.pattern.columns[matrix.pattern.row(row)]);
        let coarse = Coarse::new(&matrix.pattern, rest, usize::MAX);
        let (vector, pairs) = (vec![[0.0; 4]; rows], vec![[[0.0; 4]; 2]; rows]);
        Self {
            shares: Shares::new(&parts, &coarse.grid),
            coarse,
            matrix,
            parts,
            x: vector.clone(),
            r: vector.clone(),
            p: vector,
            st: pairs.clone(),
            sums: pairs,
        }
    }

    /// Starts an iteration: x = 0, r̃ = (L̃ + 1)⁻¹ G⁻¹ b and the coarse residual Pᵀ b, with b scaled by `factor`, and no
    /// direction.
    fn start<T: Real>(&mut self, b: &[[T; 3]], factor: f64) {
        let Self { parts, matrix, coarse, shares, r, .. } = self;
        shares.sums.fill([0.0; 4]);
        let (residual, places) = shares.all();
        Start { matrix, coarse, places, b, factor, first: 0, r, residual }.over(parts);
        shares.collect(&mut coarse.residual);
        self.x.fill([0.0; 4]);
        self.p.fill([0.0; 4]);
        self.st.fill([[0.0; 4]; 2]);
    }

    /// The next direction, and the sweeps for it; returns the curvature along it.
    fn next_direction(&mut self, beta: f32) -> f64 {
        let Self { parts, matrix, coarse, shares, r, p, st, sums, .. } = self;
        shares.sums.fill([0.0; 4]);
        let (change, places) = shares.all();
        let curvature = Sweeps { matrix, coarse, places, beta, r, first: 0, p, st, sums, change }.over(parts);
        shares.collect(&mut coarse.change);
        curvature
    }

    /// A step of length α along the direction; returns r·r.
    fn advance(&mut self, alpha: f32) -> f64 {
        let Self { parts, st, x, r, coarse, .. } = self;
        let sum = Advance { alpha, st, x, r }.rows(parts);
        for (residual, change) in coarse.residual.iter_mut().zip(&coarse.change) {
            (0..4).for_each(|k| residual[k] -= alpha * change[k]);
        }
        sum
    }

    /// x += factor G⁻ᵀ x̃
    fn add_solution<T: Real>(&self, x: &mut [[T; 3]], factor: f64) {
        for ((x, y), inverse) in x.iter_mut().zip(&self.x).zip(&self.matrix.inverses) {
            for i in 0..3 {
                let sum: f32 = (i..3).map(|k| inverse[k][i] * y[k]).sum();
                x[i] += T::of(f64::from(sum) * factor);
            }
        }
    }

    /// Conjugate gradients until r̃·r̃ has fallen by `tolerance`²; returns the number of iterations.
    fn iterate(&mut self, tolerance: f64) -> Result<usize, Breakdown> {
        let mut rr = square(&self.r);
        let target = tolerance * tolerance * rr;
        let (mut best, mut stagnation, mut before) = (f64::INFINITY, 0, f64::INFINITY);
        for iteration in 1..=MAX_ITERATIONS {
            // r·P⁻¹r: the sweeps contribute r̃·r̃.
            let rz = rr + self.coarse.solve();
            let curvature = self.next_direction((rz / before) as f32);
            before = rz;
            if !(curvature > 0.0) {
                return Err(self.no_curvature(curvature));
            }
            rr = self.advance((rz / curvature) as f32);
            if !rr.is_finite() {
                return Err(Breakdown::Singular);
            }
            if rr <= target {
                return Ok(iteration);
            }
            stagnation += 1;
            if rr < best {
                (best, stagnation) = (rr, 0);
            } else if stagnation > MAX_STAGNATION {
                return Err(Breakdown::NotConverged { residual: (best / target).sqrt() * tolerance });
            }
        }
        Err(Breakdown::NotConverged { residual: (best / target).sqrt() * tolerance })
    }

    /// The cause of a curvature p·Ãp that is not positive.
    fn no_curvature(&self, curvature: f64) -> Breakdown {
        match curvature.abs() <= ROUND_OFF * square(&self.p) {
            _ if curvature.is_nan() => Breakdown::Singular,
            true => Breakdown::NotConverged { residual: 1.0 },
            false => Breakdown::NotPositiveDefinite,
        }
    }
}

impl<T: Real> Memory<T> for Ssor {
    fn save(&self, _is_kept: bool, history: &mut History) {
        self.coarse.save(history);
    }

    fn restore(&mut self, _is_kept: bool, history: &History) -> Result<(), String> {
        self.coarse.restore(history)
    }

    /// The coarse matrix may be that of an earlier matrix; it is restored.
    fn prepare_again(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.matrix.scale = single_precision_scale(values, &self.matrix.pattern.diagonal)?;
        self.matrix.prepare(values, &self.coarse.free, &self.parts)
    }
}

impl<T: Real> ApproximateInverse<T> for Ssor {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        let scale = single_precision_scale(values, &self.matrix.pattern.diagonal)?;
        self.matrix.scale = scale;
        self.coarse.prepare(&self.matrix.pattern, values, scale);
        self.matrix.prepare(values, &self.coarse.free, &self.parts)
    }

    /// The residual is measured in the norm of the preconditioner.
    fn correct(&mut self, r: &[[T; 3]], x: &mut [[T; 3]], tolerance: f64) -> Result<usize, Breakdown> {
        let size = norm(r);
        if !(size > 0.0 && size.is_finite()) {
            return if size == 0.0 { Ok(0) } else { Err(Breakdown::Singular) };
        }
        self.start(r, 1.0 / size);
        let outcome = self.iterate(tolerance);
        self.coarse.record_effort(outcome.as_ref().ok().copied(), tolerance);
        self.add_solution(x, size * self.matrix.scale);
        outcome
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let size = norm(r);
        if !(size > 0.0 && size.is_finite()) {
            z.copy_from_slice(r);
            return;
        }
        self.start(r, 1.0 / size);
        self.coarse.correction.fill([0.0; 4]);
        self.next_direction(0.0);
        for (x, st) in self.x.iter_mut().zip(&self.st) {
            *x = st[1];
        }
        z.fill([T::default(); 3]);
        self.add_solution(z, size * self.matrix.scale);
    }

    fn bytes(&self) -> usize {
        let vectors = 3 * size_of_val(self.x.as_slice()) + 2 * size_of_val(self.st.as_slice());
        self.matrix.bytes() + self.coarse.bytes() + self.shares.bytes() + vectors
    }
}

/// r·r, accumulated in double precision.
fn square(r: &[Row]) -> f64 {
    r.as_flattened().iter().map(|r| f64::from(*r).powi(2)).sum()
}
