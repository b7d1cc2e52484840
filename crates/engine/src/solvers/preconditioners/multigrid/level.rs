//! One level: a matrix, its smoother, and the prolongation from the next coarser level.

use super::aggregate::{aggregate, centres, rigid};
use super::blocks::{Blocks, Product, add_product, row_times};
use super::cycle::{Rows, Smoother, over_rows, times};
use crate::solvers::block::invert;
use crate::solvers::parts::Part;
use fem_elements::history::{put, take};
use fem_elements::number::vectorized;
use fem_scene::simulation::{Breakdown, History};

/// Steps of the power iteration for the largest eigenvalue of D⁻¹A. It starts from the vector of the last preparation.
const POWER_STEPS: usize = 4;

/// Smallest pivot of a coarse diagonal block relative to its diagonal entry: the rotations of an aggregate of one or two nodes are not
/// independent.
const PIVOT: f32 = 1e-5;

/// A level whose nodes have D unknowns.
pub struct Level<const D: usize> {
    pub A: Blocks<D, D>,
    /// The parts of A that threads sweep over side by side.
    parts: Part,
    /// Number of each diagonal block.
    diagonal: Vec<usize>,
    inverses: Vec<[[f32; D]; D]>,
    /// Tentative prolongation: rigid motions of the aggregates.
    rigid: Blocks<D, 6>,
    /// Smoothed prolongation.
    P: Blocks<D, 6>,
    /// Restriction Pᵀ.
    R: Blocks<6, D>,
    /// Number in P of the transpose of each block of R.
    R_sources: Vec<u32>,
    AP: Blocks<D, 6>,
    slots: Vec<u32>,
    /// Vector of the power iteration.
    power: Vec<[f32; D]>,
    /// The same before the last preparation, for a checkpoint.
    power_before: Vec<[f32; D]>,
    pub b: Vec<[f32; D]>,
    pub x: Vec<[f32; D]>,
    r: Vec<[f32; D]>,
}

impl<const D: usize> Level<D> {
    /// From the pattern of A and the positions of its nodes: the level, the pattern of the coarse matrix and the coarse
    /// positions.
    pub fn new(A: Blocks<D, D>, positions: &[[f32; 3]]) -> (Self, Blocks<6, 6>, Vec<[f32; 3]>) {
        let (aggregates, count) = aggregate(&A, positions);
        let coarse_positions = centres(&aggregates, count, positions);
        let rigid = rigid(&aggregates, &coarse_positions, positions);
        let P = Blocks::product(&A, &rigid);
        let (R, R_sources) = Blocks::transpose(&P, count);
        let AP = Blocks::product(&A, &P);
        let coarse = Blocks::product(&R, &AP);
        let rows = A.rows();
        let vector = || vec![[0.0; D]; rows];
        let mut level = Self {
            parts: Part::new(rows, |row| A.row(row).0),
            diagonal: (0..rows).map(|row| diagonal(&A, row)).collect(),
            inverses: vec![[[0.0; D]; D]; rows],
            slots: vec![0; count],
            power: vector(),
            power_before: vector(),
            b: vector(),
            x: vector(),
            r: vector(),
            A,
            rigid,
            P,
            R,
            R_sources,
            AP,
        };
        level.restart_power();
        (level, coarse, coarse_positions)
    }

    /// Computes the smoother, the prolongation and the coarse matrix Pᵀ A P from the values of A.
    pub fn prepare(&mut self, coarse: &mut Blocks<6, 6>) -> Result<(), Breakdown> {
        self.power_before.copy_from_slice(&self.power);
        for (inverse, &block) in self.inverses.iter_mut().zip(&self.diagonal) {
            *inverse = invert(&self.A.values[block])?;
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
        Product { A: &self.A, B: &self.P, C: &mut self.AP, slots: &mut self.slots }.compute();
        Product { A: &self.R, B: &self.AP, C: coarse, slots: &mut self.slots }.compute();
        for row in 0..coarse.rows() {
            let block = diagonal(coarse, row);
            regularize(&mut coarse.values[block]);
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
        Product { A: &self.A, B: &self.rigid, C: &mut self.P, slots: &mut self.slots }.compute();
        for row in 0..self.A.rows() {
            let mut scaled = self.inverses[row];
            scaled.as_flattened_mut().iter_mut().for_each(|entry| *entry *= -omega);
            let (own, motion) = (self.rigid.columns[row], &self.rigid.values[row]);
            for block in self.P.starts[row]..self.P.starts[row + 1] {
                let mut smoothed = if self.P.columns[block] == own { *motion } else { [[0.0; 6]; D] };
                add_product(&scaled, &self.P.values[block], &mut smoothed);
                self.P.values[block] = smoothed;
            }
        }
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
        self.A.bytes() + self.rigid.bytes() + self.P.bytes() + self.R.bytes() + self.AP.bytes() + vectors
    }
}

/// Enlarges the diagonal entries whose pivots are too small in a factorisation of the block. The others stay as they are: a shift of
/// all would exceed the smallest eigenvalues of a slender body.
fn regularize(block: &mut [[f32; 6]; 6]) {
    let most = (0..6).map(|i| block[i][i]).fold(0.0, f32::max);
    let mut L = [[0.0f32; 6]; 6];
    for j in 0..6 {
        let entry = block[j][j];
        let least = PIVOT * if entry > PIVOT * most { entry } else { most };
        let pivot = entry - (0..j).map(|k| L[j][k] * L[j][k]).sum::<f32>();
        if pivot < least {
            block[j][j] += least - pivot;
        }
        L[j][j] = pivot.max(least).sqrt();
        for i in j + 1..6 {
            L[i][j] = (block[i][j] - (0..j).map(|k| L[i][k] * L[j][k]).sum::<f32>()) / L[j][j];
        }
    }
}

/// Number of the diagonal block of a row.
fn diagonal<const D: usize>(A: &Blocks<D, D>, row: usize) -> usize {
    A.starts[row] + A.row(row).0.partition_point(|&column| (column as usize) < row)
}
