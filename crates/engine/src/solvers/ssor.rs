//! Conjugate gradients with one sweep of Gauss and Seidel forwards and one backwards for preconditioner, arranged so that an
//! iteration costs the two sweeps and no product: Eisenstat, Efficient Implementation of a Class of Preconditioned Conjugate
//! Gradient Methods (1981). In single precision: what it solves for is a correction.
//!
//! With A = L + D + Lᵀ, the preconditioner is (L + W) W⁻¹ (W + Lᵀ), where W = G Gᵀ is near D: less what an incomplete
//! factorisation would take from the diagonal blocks. Scaled by G, the matrix is L̃ + K + 2 + L̃ᵀ with L̃ = G⁻¹ L G⁻ᵀ and
//! K = G⁻¹ D G⁻ᵀ − 2, and the preconditioner is (L̃ + 1)(1 + L̃ᵀ).

mod sweeps;

use super::Breakdown;
use super::block_jacobi::{factor, invert_lower};
use crate::number::{Real, vectorized};
use crate::sparse::Pattern;
use sweeps::{Backward, Forward};

/// Parts of an incomplete factorisation's change of the diagonal that are tried, one after the other, until it succeeds: half of
/// it takes fewest iterations on beams, all of it mostly breaks down, none of it is Gauss and Seidel's own.
const PARTS: [f32; 2] = [0.5, 0.0];

/// Part of the diagonal that it must leave.
const LEAST: f32 = 0.02;

/// The most iterations of one solve.
const MOST: usize = 2000;

/// Iterations without a smaller residual after which single precision gives no more.
const PATIENCE: usize = 50;

/// A curvature this small, where the preconditioned matrix has eigenvalues up to about 1, is none in single precision.
const ROUND_OFF: f64 = 1e-5;

/// Rows whose squares are summed in single precision, before the sum goes on in double.
const ROWS_AT_ONCE: usize = 64;

/// Rows of four numbers: three, and a zero that fills a register.
pub(super) type Row = [f32; 4];

/// A scaled matrix, and what iterations need.
pub(super) struct Ssor {
    places: Places,
    /// L̃, row by row.
    L: Vec<[Row; 3]>,
    /// K.
    K: Vec<[Row; 3]>,
    /// G⁻¹.
    inverses: Vec<[[f32; 3]; 3]>,
    /// What the matrix is multiplied with, so that single precision holds it.
    scale: f64,
    x: Vec<Row>,
    r: Vec<Row>,
    p: Vec<Row>,
    t: Vec<Row>,
    s: Vec<Row>,
}

/// Where the blocks below the diagonal are.
pub(super) struct Places {
    pub starts: Vec<u32>,
    pub columns: Vec<u32>,
    /// Number in the matrix of each of those blocks, and of the diagonal ones.
    sources: Vec<u32>,
    diagonal: Vec<u32>,
}

impl Ssor {
    /// For a pattern of which all blocks are stored, or the lower half.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let (mut starts, mut columns, mut sources) = (vec![0], Vec::new(), Vec::new());
        for row in 0..pattern.rows() {
            for block in pattern.row(row).filter(|&block| (pattern.columns[block] as usize) < row) {
                columns.push(pattern.columns[block]);
                sources.push(block as u32);
            }
            starts.push(columns.len() as u32);
        }
        let diagonal = pattern.diagonal().map(|block| block as u32).collect();
        let rows = pattern.rows();
        let vector = || vec![[0.0; 4]; rows];
        Self {
            L: vec![[[0.0; 4]; 3]; columns.len()],
            K: vec![[[0.0; 4]; 3]; rows],
            inverses: vec![[[0.0; 3]; 3]; rows],
            places: Places { starts, columns, sources, diagonal },
            scale: 1.0,
            x: vector(),
            r: vector(),
            p: vector(),
            t: vector(),
            s: vector(),
        }
    }

    /// Scales a matrix.
    pub(super) fn prepare<T: Real>(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        let entries = |&block: &u32| (0..3).map(move |i| values[block as usize][i][i].as_f64());
        let largest = self.places.diagonal.iter().flat_map(entries).fold(0.0, f64::max);
        if !(largest > 0.0 && largest.is_finite()) {
            return Err(Breakdown::Singular);
        }
        self.scale = 1.0 / largest;
        let mut outcome = Ok(());
        for part in PARTS {
            outcome = self.scaled(values, part);
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    fn scaled<T: Real>(&mut self, values: &[[[T; 3]; 3]], part: f32) -> Result<(), Breakdown> {
        let Self { places, L, K, inverses, scale, .. } = self;
        let single = |block: u32| values[block as usize].map(|row| row.map(|entry| (entry.as_f64() * *scale) as f32));
        for row in 0..places.diagonal.len() {
            let blocks = places.starts[row] as usize..places.starts[row + 1] as usize;
            let diagonal = single(places.diagonal[row]);
            let mut W = diagonal;
            for block in blocks.clone() {
                let column = places.columns[block] as usize;
                let half = times_transpose(&single(places.sources[block]), &inverses[column]);
                for i in 0..3 {
                    for j in 0..3 {
                        W[i][j] -= part * (0..3).map(|k| half[i][k] * half[j][k]).sum::<f32>();
                    }
                    L[block][i][..3].copy_from_slice(&half[i]);
                }
            }
            if part > 0.0 && (0..3).any(|i| !(W[i][i] > LEAST * diagonal[i][i])) {
                return Err(Breakdown::NotPositiveDefinite);
            }
            let inverse = invert_lower(&factor(&W)?);
            for block in blocks {
                let half: [[f32; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| L[block][i][j]));
                let whole = times(&inverse, &half);
                (0..3).for_each(|i| L[block][i][..3].copy_from_slice(&whole[i]));
            }
            let scaled = times_transpose(&times(&inverse, &diagonal), &inverse);
            for i in 0..3 {
                (0..3).for_each(|j| K[row][i][j] = scaled[i][j] - if i == j { 2.0 } else { 0.0 });
            }
            inverses[row] = inverse;
        }
        Ok(())
    }

    /// Adds to x a correction d of A d = r, to `tolerance` in the norm of the preconditioner. Returns the iterations.
    pub(super) fn correct<T: Real>(
        &mut self,
        r: &[[T; 3]],
        x: &mut [[T; 3]],
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        let size = super::norm(r);
        if !(size > 0.0 && size.is_finite()) {
            return if size == 0.0 { Ok(0) } else { Err(Breakdown::Singular) };
        }
        self.take(r, 1.0 / size);
        let outcome = self.iterate(tolerance);
        self.give(x, size * self.scale);
        outcome
    }

    /// z = P⁻¹ r
    pub(super) fn apply<T: Real>(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let size = super::norm(r);
        if !(size > 0.0 && size.is_finite()) {
            z.copy_from_slice(r);
            return;
        }
        self.take(r, 1.0 / size);
        let Self { places, L, p, t, .. } = self;
        vectorized(Backward { places, L, p, t });
        self.x.copy_from_slice(&self.t);
        z.fill([T::default(); 3]);
        self.give(z, size * self.scale);
    }

    /// r̃ = (L̃ + 1)⁻¹ G⁻¹ r, x = 0, and p = r̃
    fn take<T: Real>(&mut self, r: &[[T; 3]], factor: f64) {
        for (row, r) in r.iter().enumerate() {
            let r = r.map(|r| (r.as_f64() * factor) as f32);
            let inverse = &self.inverses[row];
            let mut scaled: [f32; 3] = std::array::from_fn(|i| (0..=i).map(|j| inverse[i][j] * r[j]).sum());
            for block in self.places.starts[row] as usize..self.places.starts[row + 1] as usize {
                let known = &self.r[self.places.columns[block] as usize];
                (0..3).for_each(|i| scaled[i] -= (0..3).map(|k| self.L[block][i][k] * known[k]).sum::<f32>());
            }
            self.r[row] = [scaled[0], scaled[1], scaled[2], 0.0];
        }
        self.x.fill([0.0; 4]);
        self.p.copy_from_slice(&self.r);
    }

    /// x += factor G⁻ᵀ x̃
    fn give<T: Real>(&self, x: &mut [[T; 3]], factor: f64) {
        for ((x, y), inverse) in x.iter_mut().zip(&self.x).zip(&self.inverses) {
            for i in 0..3 {
                let sum: f32 = (i..3).map(|k| inverse[k][i] * y[k]).sum();
                x[i] += T::of(f64::from(sum) * factor);
            }
        }
    }

    fn iterate(&mut self, tolerance: f64) -> Result<usize, Breakdown> {
        let mut rr = square(&self.r);
        let target = tolerance * tolerance * rr;
        let (mut best, mut since) = (f64::INFINITY, 0);
        for iteration in 1..=MOST {
            let Self { places, L, K, x, r, p, t, s, .. } = self;
            vectorized(Backward { places, L, p, t });
            let curvature = vectorized(Forward { places, L, K, p, t, s });
            if !(curvature > 0.0) {
                return Err(self.no_curvature(curvature));
            }
            let after = advance((rr / curvature) as f32, t, s, x, r);
            if !after.is_finite() {
                return Err(Breakdown::Singular);
            }
            if after <= target {
                return Ok(iteration);
            }
            since += 1;
            if after < best {
                (best, since) = (after, 0);
            } else if since > PATIENCE {
                return Err(Breakdown::NotConverged { residual: (best / target).sqrt() * tolerance });
            }
            let beta = (after / rr) as f32;
            for (p, r) in p.as_flattened_mut().iter_mut().zip(r.as_flattened()) {
                *p = r + beta * *p;
            }
            rr = after;
        }
        Err(Breakdown::NotConverged { residual: (best / target).sqrt() * tolerance })
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
        let places = &self.places;
        let numbers = places.starts.len() + 2 * places.columns.len() + places.diagonal.len();
        let vectors = 5 * size_of_val(self.x.as_slice()) + size_of_val(self.inverses.as_slice());
        4 * numbers + size_of_val(self.L.as_slice()) + size_of_val(self.K.as_slice()) + vectors
    }
}

/// x += α t, r −= α (t + s); returns r·r.
fn advance(alpha: f32, t: &[Row], s: &[Row], x: &mut [Row], r: &mut [Row]) -> f64 {
    let mut sum = 0.0;
    let vectors = t.chunks(ROWS_AT_ONCE).zip(s.chunks(ROWS_AT_ONCE));
    for ((t, s), (x, r)) in vectors.zip(x.chunks_mut(ROWS_AT_ONCE).zip(r.chunks_mut(ROWS_AT_ONCE))) {
        let mut squares = [0.0; 4];
        for row in 0..t.len() {
            for k in 0..4 {
                x[row][k] += alpha * t[row][k];
                r[row][k] -= alpha * (t[row][k] + s[row][k]);
                squares[k] += r[row][k] * r[row][k];
            }
        }
        sum += f64::from(squares.iter().sum::<f32>());
    }
    sum
}

fn square(r: &[Row]) -> f64 {
    r.as_flattened().iter().map(|r| f64::from(*r).powi(2)).sum()
}

/// A B
fn times(A: &[[f32; 3]; 3], B: &[[f32; 3]; 3]) -> [[f32; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j]))
}

/// A Bᵀ
fn times_transpose(A: &[[f32; 3]; 3], B: &[[f32; 3]; 3]) -> [[f32; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| A[i][0] * B[j][0] + A[i][1] * B[j][1] + A[i][2] * B[j][2]))
}
