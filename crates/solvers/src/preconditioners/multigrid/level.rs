//! One level: a matrix, its smoother, and the prolongation from the next coarser level.

use super::aggregate::{aggregate, centres};
use super::blocks::{Blocks, add_product, double, multiply, multiply_symmetric, row_times};
use super::cycle::{Rows, Smoother, over_rows, times};
use super::motions::{Motion, orthonormal};
use crate::block::invert;
use crate::parts::Part;
use pulp::{Simd, WithSimd};

use fem_elements::history::{put, take};
use fem_elements::number::vectorized;
use fem_model::simulation::{Breakdown, History};

/// Steps of the power iteration for the largest eigenvalue of D⁻¹A. It starts from the vector of the last preparation.
const POWER_STEPS: usize = 4;

/// A level whose nodes have D unknowns.
pub struct Level<const D: usize> {
    /// The matrix in double precision: rounded to single, it would lose the bending stiffness of a slender body, whose smallest eigenvalues are
    /// below the round-off of the largest, and the coarse matrices would not be positive definite.
    pub exact: Blocks<D, D, f64>,
    /// The same in single precision, for the smoother. Its round-off there does not spoil the cycle, which stays positive definite if the coarse
    /// matrices are.
    A: Blocks<D, D>,
    /// The parts of A that threads sweep over side by side.
    parts: Part,
    /// Number of each diagonal block.
    diagonal: Vec<usize>,
    inverses: Vec<[[f32; D]; D]>,
    /// Tentative prolongation: orthonormal rigid motions of the aggregates.
    rigid: Blocks<D, 6>,
    /// Smoothed prolongation.
    P: Blocks<D, 6>,
    /// Restriction Pᵀ.
    R: Blocks<6, D>,
    /// Number in P of the transpose of each block of R.
    R_sources: Vec<u32>,
    /// The blocks of A P that the lower half of Pᵀ A P needs.
    AP: Blocks<D, 6, f64>,
    slots: Vec<u32>,
    /// Workspace for a row of A P̂.
    row: Vec<[[f64; 6]; D]>,
    /// Vector of the power iteration.
    power: Vec<[f32; D]>,
    /// The same before the last preparation, for a checkpoint.
    power_before: Vec<[f32; D]>,
    pub b: Vec<[f32; D]>,
    pub x: Vec<[f32; D]>,
    r: Vec<[f32; D]>,
}

impl<const D: usize> Level<D> {
    /// From the pattern of A and the rigid motions and positions of its nodes: the level, the pattern of the coarse matrix and the coarse
    /// motions and positions.
    pub fn new(
        exact: Blocks<D, D, f64>,
        motions: &[Motion<D>],
        positions: &[[f64; 3]],
    ) -> (Self, Blocks<6, 6, f64>, Vec<Motion<6>>, Vec<[f64; 3]>) {
        let A = Blocks::zeros(exact.starts.clone(), exact.columns.clone());
        let (aggregates, count) = aggregate(&A, positions);
        let coarse_positions = centres(&aggregates, count, positions);
        let (rigid, coarse_motions) = orthonormal(&aggregates, &coarse_positions, (motions, positions));
        let P = Blocks::product(&A, &rigid);
        let (R, R_sources) = Blocks::transpose(&P, count);
        let AP = Blocks::<D, 6, f64>::product(&A, &P);
        let coarse = Blocks::product(&R, &AP);
        let AP = AP.left_of_last(&P);
        let rows = A.rows();
        let vector = || vec![[0.0; D]; rows];
        let mut level = Self {
            parts: Part::new(rows, |row| A.row(row).0),
            diagonal: (0..rows).map(|row| diagonal(&A, row)).collect(),
            inverses: vec![[[0.0; D]; D]; rows],
            slots: vec![0; count],
            row: vec![[[0.0; 6]; D]; longest_row(&P)],
            power: vector(),
            power_before: vector(),
            b: vector(),
            x: vector(),
            r: vector(),
            exact,
            A,
            rigid,
            P,
            R,
            R_sources,
            AP,
        };
        level.restart_power();
        (level, coarse, coarse_motions, coarse_positions)
    }

    /// Computes the smoother, the prolongation and the coarse matrix Pᵀ A P from the values of A.
    pub fn prepare(&mut self, coarse: &mut Blocks<6, 6, f64>) -> Result<(), Breakdown> {
        self.power_before.copy_from_slice(&self.power);
        for (single, exact) in self.A.values.iter_mut().zip(&self.exact.values) {
            *single = exact.map(|row| row.map(|entry| entry as f32));
        }
        for (inverse, &block) in self.inverses.iter_mut().zip(&self.diagonal) {
            *inverse = invert(&self.exact.values[block])?.map(|row| row.map(|entry| entry as f32));
        }
        let largest = self.largest_eigenvalue();
        if !largest.is_finite() {
            self.restart_power();
            return Err(Breakdown::Singular);
        }
        self.smooth_prolongation(4.0 / (3.0 * largest));
        for (transpose, &source) in self.R.values.iter_mut().zip(&self.R_sources) {
            let block = &self.P.values[source as usize];
            *transpose = std::array::from_fn(|i| std::array::from_fn(|j| block[j][i]));
        }
        multiply(&self.exact, &self.P, &mut self.AP);
        multiply_symmetric(&self.R, &self.AP, coarse, &mut self.slots);
        for row in 0..coarse.rows() {
            let block = diagonal(coarse, row);
            fix_missing_motions(&mut coarse.values[block]);
        }
        Ok(())
    }

    /// Adds the vector with which the last preparation began, if its result is kept, or else that of the next one.
    pub fn save(&self, is_kept: bool, name: &str, history: &mut History) {
        put(history, name, if is_kept { &self.power_before } else { &self.power }.as_flattened());
    }

    /// Takes over the vector with which the next preparation begins.
    pub fn restore(&mut self, name: &str, history: &History) -> Result<(), String> {
        take(history, name, self.power.as_flattened_mut())
    }

    /// Sets an oscillating start vector, at first and after a matrix that was not finite.
    fn restart_power(&mut self) {
        for (number, entry) in self.power.as_flattened_mut().iter_mut().enumerate() {
            *entry = (number * 7 % 11) as f32 - 5.0;
        }
    }

    /// P = (1 − ω D⁻¹ A) P̂, with P̂ the tentative prolongation.
    fn smooth_prolongation(&mut self, omega: f32) {
        vectorized(Smoothing { level: self, omega: f64::from(omega) });
    }

    /// Estimate of the largest eigenvalue of D⁻¹A.
    fn largest_eigenvalue(&mut self) -> f32 {
        let mut largest = 1.0;
        for _ in 0..POWER_STEPS {
            let Self { A, inverses, power, r, .. } = self;
            over_rows(r, |first, r| {
                for (row, r) in r.iter_mut().enumerate() {
                    *r = times(&inverses[first + row], &row_times(A, first + row, power));
                }
            });
            let size = |x: &[[f32; D]]| x.as_flattened().iter().map(|x| f64::from(x * x)).sum::<f64>().sqrt();
            let (before, after) = (size(&self.power), size(&self.r));
            largest = (after / before) as f32;
            for (power, r) in self.power.as_flattened_mut().iter_mut().zip(self.r.as_flattened()) {
                *power = r / largest;
            }
        }
        largest
    }

    /// Smooths from x = 0 and restricts the residual: `coarse` = Pᵀ (b − A x).
    pub fn descend(&mut self, coarse: &mut [[f32; 6]]) {
        let Self { A, parts, diagonal, inverses, R, b, x, r, .. } = self;
        Smoother { A, diagonal, inverses, b }.forward(parts, x, r);
        over_rows(coarse, |first, y| vectorized(Rows { A: R, x: r, first, y }));
    }

    /// Adds the coarse correction and smooths in the reverse order, so that the whole cycle is symmetric.
    pub fn ascend(&mut self, coarse: &[[f32; 6]]) {
        let Self { A, parts, diagonal, inverses, P, b, x, r, .. } = self;
        over_rows(r, |first, y| vectorized(Rows { A: P, x: coarse, first, y }));
        for (x, r) in x.as_flattened_mut().iter_mut().zip(r.as_flattened_mut()) {
            *x += std::mem::take(r);
        }
        Smoother { A, diagonal, inverses, b }.backward(parts, x, r);
    }

    pub fn bytes(&self) -> usize {
        let vectors = 5 * size_of_val(self.x.as_slice()) + size_of_val(self.inverses.as_slice());
        self.A.bytes()
            + self.exact.bytes()
            + self.rigid.bytes()
            + self.P.bytes()
            + self.R.bytes()
            + self.AP.bytes()
            + vectors
    }
}

/// The computation of P row by row.
struct Smoothing<'a, const D: usize> {
    level: &'a mut Level<D>,
    omega: f64,
}

impl<const D: usize> WithSimd for Smoothing<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { level: Level { exact, inverses, rigid, P, slots, row, .. }, omega } = self;
        for i in 0..exact.rows() {
            let blocks = P.starts[i]..P.starts[i + 1];
            let row = &mut row[..blocks.len()];
            row.fill([[0.0; 6]; D]);
            for (place, &column) in P.columns[blocks.clone()].iter().enumerate() {
                slots[column as usize] = place as u32;
            }
            let (columns, values) = exact.row(i);
            for (&k, a) in columns.iter().zip(values) {
                let k = k as usize;
                add_product(a, &double(&rigid.values[k]), &mut row[slots[rigid.columns[k] as usize] as usize]);
            }
            let mut scaled = double(&inverses[i]);
            scaled.as_flattened_mut().iter_mut().for_each(|entry| *entry *= -omega);
            for ((P, product), &column) in P.values[blocks.clone()].iter_mut().zip(&*row).zip(&P.columns[blocks]) {
                let is_own = column == rigid.columns[i];
                let mut smoothed = if is_own { double(&rigid.values[i]) } else { [[0.0; 6]; D] };
                add_product(&scaled, product, &mut smoothed);
                *P = smoothed.map(|row| row.map(|entry| entry as f32));
            }
        }
    }
}

/// Gives a stiffness to the motions that an aggregate lacks: their rows are zero, no other row knows them, and no load reaches them.
fn fix_missing_motions(block: &mut [[f64; 6]; 6]) {
    let most = (0..6).map(|i| block[i][i]).fold(0.0, f64::max);
    for i in 0..6 {
        if block[i].iter().all(|entry| *entry == 0.0) {
            block[i][i] = most;
        }
    }
}

/// Number of the diagonal block of a row.
fn diagonal<const D: usize, F: Copy + Default>(A: &Blocks<D, D, F>, row: usize) -> usize {
    A.starts[row] + A.row(row).0.partition_point(|&column| (column as usize) < row)
}

/// The largest number of blocks in a row.
fn longest_row<const R: usize, const C: usize>(A: &Blocks<R, C>) -> usize {
    (0..A.rows()).map(|row| A.row(row).0.len()).max().unwrap_or(0)
}
