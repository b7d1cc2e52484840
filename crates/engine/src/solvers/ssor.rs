//! Conjugate gradients with one sweep of Gauss and Seidel forwards and one backwards for preconditioner, arranged so that an
//! iteration costs the two sweeps and no product: Eisenstat, Efficient Implementation of a Class of Preconditioned Conjugate
//! Gradient Methods (1981). In single precision: what it solves for is a correction.
//!
//! With A = L + D + Lᵀ, the preconditioner is (L + W) W⁻¹ (W + Lᵀ), where W = G Gᵀ is near D: less what an incomplete
//! factorisation would take from the diagonal blocks. Scaled by G, the matrix is L̃ + K + 2 + L̃ᵀ with L̃ = G⁻¹ L G⁻ᵀ and
//! K = G⁻¹ D G⁻ᵀ − 2, and the preconditioner is (L̃ + 1)(1 + L̃ᵀ). Its inverse takes the oscillating part of a correction well and
//! the smooth part badly, so the inverse of the matrix on a coarse grid is added.

mod coarse;
mod grid;
mod scaled;
mod sweeps;

use std::array::from_fn;

use super::Breakdown;
use crate::number::{Real, vectorized};
use crate::sparse::Pattern;
use crate::vector::norm;
use coarse::Coarse;
use scaled::Scaled;
use sweeps::{Backward, Forward};

/// The most iterations of one solve.
const MOST: usize = 2000;

/// Iterations without a smaller residual after which single precision gives no more.
const PATIENCE: usize = 50;

/// A curvature this small, where the preconditioned matrix has eigenvalues up to about 1, is none in single precision.
const ROUND_OFF: f64 = 1e-5;

/// Rows whose squares are summed in single precision, before the sum goes on in double.
const ROWS_AT_ONCE: usize = 64;

/// Rows of four numbers: three, and a zero that fills a register.
type Row = [f32; 4];

/// Two of them.
type Pair = [Row; 2];

/// A preconditioned matrix, and what iterations need.
pub(super) struct Ssor {
    matrix: Scaled,
    coarse: Coarse,
    x: Vec<Row>,
    r: Vec<Row>,
    p: Vec<Row>,
    /// What the sweeps make of the direction: s forwards, t backwards.
    st: Vec<Pair>,
    /// What the backward sweep has summed up for rows that it has not reached.
    sums: Vec<Pair>,
}

impl Ssor {
    /// For a pattern of which all blocks are stored, or the lower half, and the places of its nodes.
    pub(super) fn new(pattern: &Pattern, rest: &[[f64; 3]]) -> Self {
        let rows = pattern.rows();
        let (vector, pairs) = (vec![[0.0; 4]; rows], vec![[[0.0; 4]; 2]; rows]);
        Self {
            matrix: Scaled::new(pattern),
            coarse: Coarse::new(pattern, rest),
            x: vector.clone(),
            r: vector.clone(),
            p: vector,
            st: pairs.clone(),
            sums: pairs,
        }
    }

    /// Scales a matrix.
    pub(super) fn prepare<T: Real>(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        let scale = self.matrix.choose_scale(values)?;
        self.coarse.prepare(&self.matrix.places, values, scale);
        self.matrix.prepare(values, &self.coarse.moves)
    }

    /// Adds to x a correction d of A d = r, to `tolerance` in the norm of the preconditioner. Returns the iterations.
    pub(super) fn correct<T: Real>(
        &mut self,
        r: &[[T; 3]],
        x: &mut [[T; 3]],
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        let size = norm(r);
        if !(size > 0.0 && size.is_finite()) {
            return if size == 0.0 { Ok(0) } else { Err(Breakdown::Singular) };
        }
        self.take(r, 1.0 / size);
        let outcome = self.iterate(tolerance);
        self.coarse.wear(outcome.as_ref().ok().copied(), tolerance);
        self.give(x, size * self.matrix.scale);
        outcome
    }

    /// z = P⁻¹ r
    pub(super) fn apply<T: Real>(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let size = norm(r);
        if !(size > 0.0 && size.is_finite()) {
            z.copy_from_slice(r);
            return;
        }
        self.take(r, 1.0 / size);
        self.coarse.correction.fill([0.0; 4]);
        self.direct(0.0);
        for (x, st) in self.x.iter_mut().zip(&self.st) {
            *x = st[1];
        }
        z.fill([T::default(); 3]);
        self.give(z, size * self.matrix.scale);
    }

    /// r̃ = (L̃ + 1)⁻¹ G⁻¹ r and Pᵀ r, x = 0, and no direction before
    fn take<T: Real>(&mut self, r: &[[T; 3]], factor: f64) {
        let Scaled { places, L, inverses, .. } = &self.matrix;
        self.coarse.residual.fill([0.0; 4]);
        for (row, r) in r.iter().enumerate() {
            let r = r.map(|r| (r.as_f64() * factor) as f32);
            self.coarse.restrict(row, &r);
            let mut scaled: [f32; 3] = from_fn(|i| (0..=i).map(|j| inverses[row][i][j] * r[j]).sum());
            for block in places.row(row) {
                let known = &self.r[places.columns[block] as usize];
                (0..3).for_each(|i| scaled[i] -= (0..3).map(|k| L[9 * block + 3 * i + k] * known[k]).sum::<f32>());
            }
            self.r[row] = [scaled[0], scaled[1], scaled[2], 0.0];
        }
        self.x.fill([0.0; 4]);
        self.p.fill([0.0; 4]);
        self.st.fill([[0.0; 4]; 2]);
    }

    /// The next direction.
    fn direct(&mut self, beta: f32) {
        let Self { matrix, coarse, r, p, st, sums, .. } = self;
        vectorized(Backward { matrix, coarse, beta, r, p, st, sums });
    }

    /// x += factor G⁻ᵀ x̃
    fn give<T: Real>(&self, x: &mut [[T; 3]], factor: f64) {
        for ((x, y), inverse) in x.iter_mut().zip(&self.x).zip(&self.matrix.inverses) {
            for i in 0..3 {
                let sum: f32 = (i..3).map(|k| inverse[k][i] * y[k]).sum();
                x[i] += T::of(f64::from(sum) * factor);
            }
        }
    }

    fn iterate(&mut self, tolerance: f64) -> Result<usize, Breakdown> {
        let mut rr = square(&self.r);
        let target = tolerance * tolerance * rr;
        let (mut best, mut since, mut before) = (f64::INFINITY, 0, f64::INFINITY);
        for iteration in 1..=MOST {
            // The product of the residual with what both corrections make of it.
            let rz = rr + self.coarse.solve();
            self.direct((rz / before) as f32);
            before = rz;
            let Self { matrix, coarse, p, st, .. } = self;
            let curvature = vectorized(Forward { matrix, coarse, p, st });
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
            since += 1;
            if rr < best {
                (best, since) = (rr, 0);
            } else if since > PATIENCE {
                return Err(Breakdown::NotConverged { residual: (best / target).sqrt() * tolerance });
            }
        }
        Err(Breakdown::NotConverged { residual: (best / target).sqrt() * tolerance })
    }

    /// x += α t, r −= α (t + s); returns r·r.
    fn advance(&mut self, alpha: f32) -> f64 {
        let Self { st, x, r, coarse, .. } = self;
        let mut sum = 0.0;
        let chunks = st.chunks(ROWS_AT_ONCE).zip(x.chunks_mut(ROWS_AT_ONCE)).zip(r.chunks_mut(ROWS_AT_ONCE));
        for ((st, x), r) in chunks {
            let mut squares = [0.0; 4];
            for (([s, t], x), r) in st.iter().zip(x).zip(r) {
                for k in 0..4 {
                    x[k] += alpha * t[k];
                    r[k] -= alpha * (t[k] + s[k]);
                    squares[k] += r[k] * r[k];
                }
            }
            sum += f64::from(squares.iter().sum::<f32>());
        }
        for (residual, change) in coarse.residual.iter_mut().zip(&coarse.change) {
            (0..4).for_each(|k| residual[k] -= alpha * change[k]);
        }
        sum
    }

    /// What it means that p·Ãp is not positive.
    fn no_curvature(&self, curvature: f64) -> Breakdown {
        match curvature.abs() <= ROUND_OFF * square(&self.p) {
            _ if curvature.is_nan() => Breakdown::Singular,
            true => Breakdown::NotConverged { residual: 1.0 },
            false => Breakdown::NotPositiveDefinite,
        }
    }

    pub(super) fn bytes(&self) -> usize {
        let vectors = 3 * size_of_val(self.x.as_slice()) + 2 * size_of_val(self.st.as_slice());
        self.matrix.bytes() + self.coarse.bytes() + vectors
    }
}

fn square(r: &[Row]) -> f64 {
    r.as_flattened().iter().map(|r| f64::from(*r).powi(2)).sum()
}
