//! The parts of a cycle on one level. Threads share the products; a sweep goes from row to row.

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::blocks::{Blocks, row_times, sum_products};

/// From this many numbers on several threads share the rows of a vector, so many at a time.
const NUMBERS: [usize; 2] = [9000, 3000];

/// Calls `work` for chunks of rows with the first row of each.
pub fn over_rows<X: Send, const D: usize>(rows: &mut [[X; D]], work: impl Fn(usize, &mut [[X; D]]) + Sync) {
    if D * rows.len() < NUMBERS[0] {
        return work(0, rows);
    }
    let chunk = NUMBERS[1] / D;
    rows.par_chunks_mut(chunk).enumerate().for_each(|(number, rows)| work(number * chunk, rows));
}

/// A x for a block.
#[inline(always)]
pub fn times<const D: usize>(A: &[[f32; D]; D], x: &[f32; D]) -> [f32; D] {
    std::array::from_fn(|i| (0..D).map(|j| A[i][j] * x[j]).sum())
}

/// Forward Gauss–Seidel from x = 0.
pub struct Forward<'a, const D: usize> {
    pub A: &'a Blocks<D, D>,
    pub diagonal: &'a [usize],
    pub inverses: &'a [[[f32; D]; D]],
    pub b: &'a [[f32; D]],
    pub x: &'a mut [[f32; D]],
}

impl<const D: usize> WithSimd for Forward<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { A, diagonal, inverses, b, x } = self;
        for row in 0..A.rows() {
            let before = A.starts[row]..diagonal[row];
            let product = sum_products(&A.columns[before.clone()], &A.values[before], x);
            x[row] = times(&inverses[row], &std::array::from_fn(|i| b[row][i] - product[i]));
        }
    }
}

/// Backward Gauss–Seidel.
pub struct Backward<'a, const D: usize> {
    pub A: &'a Blocks<D, D>,
    pub inverses: &'a [[[f32; D]; D]],
    pub b: &'a [[f32; D]],
    pub x: &'a mut [[f32; D]],
}

impl<const D: usize> WithSimd for Backward<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { A, inverses, b, x } = self;
        for row in (0..A.rows()).rev() {
            let product = row_times(A, row, x);
            let change = times(&inverses[row], &std::array::from_fn(|i| b[row][i] - product[i]));
            (0..D).for_each(|i| x[row][i] += change[i]);
        }
    }
}

/// r = −(blocks right of the diagonal) x in the rows from `first` on.
pub struct Upper<'a, const D: usize> {
    pub A: &'a Blocks<D, D>,
    pub diagonal: &'a [usize],
    pub x: &'a [[f32; D]],
    pub first: usize,
    pub r: &'a mut [[f32; D]],
}

impl<const D: usize> WithSimd for Upper<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { A, diagonal, x, first, r } = self;
        for (row, r) in r.iter_mut().enumerate() {
            let after = diagonal[first + row] + 1..A.starts[first + row + 1];
            *r = sum_products(&A.columns[after.clone()], &A.values[after], x).map(|product| -product);
        }
    }
}

/// y = A x in the rows from `first` on.
pub struct Rows<'a, const R: usize, const C: usize> {
    pub A: &'a Blocks<R, C>,
    pub x: &'a [[f32; C]],
    pub first: usize,
    pub y: &'a mut [[f32; R]],
}

impl<const R: usize, const C: usize> WithSimd for Rows<'_, R, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { A, x, first, y } = self;
        for (row, y) in y.iter_mut().enumerate() {
            *y = row_times(A, first + row, x);
        }
    }
}
