//! The parts of a cycle on one level. Threads share the rows of products, and sweep side by side over the parts of a matrix.
//!
//! The matrices are symmetric, so a sweep reads the blocks left of the diagonal alone and applies each one twice: to its row, and transposed to
//! its column.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::blocks::{Blocks, row_times, sum_products};
use crate::parts::Part;
use fem_elements::number::vectorized;
use fem_elements::threads::{join, over_parts};

/// From this many numbers on several threads share the rows of a vector, so many at a time.
const NUMBERS: [usize; 2] = [9000, 3000];

/// Calls `work` for chunks of rows with the first row of each.
pub fn over_rows<X: Send, const D: usize>(rows: &mut [[X; D]], work: impl Fn(usize, &mut [[X; D]]) + Sync) {
    if D * rows.len() < NUMBERS[0] {
        return work(0, rows);
    }
    over_parts(rows, NUMBERS[1] / D, &work);
}

/// A x for a block.
#[inline(always)]
pub fn times<const D: usize>(A: &[[f32; D]; D], x: &[f32; D]) -> [f32; D] {
    std::array::from_fn(|i| (0..D).map(|j| A[i][j] * x[j]).sum())
}

/// y += Aᵀ x for a block.
#[inline(always)]
fn add_transposed<const D: usize>(A: &[[f32; D]; D], x: &[f32; D], y: &mut [f32; D]) {
    for i in 0..D {
        for j in 0..D {
            y[j] += A[i][j] * x[i];
        }
    }
}

/// Gauss–Seidel sweeps for A x = b over the parts of A. Vectors that a sweep writes begin with the first row of its part.
#[derive(Clone, Copy)]
pub struct Smoother<'a, const D: usize> {
    pub A: &'a Blocks<D, D>,
    /// Number of each diagonal block.
    pub diagonal: &'a [usize],
    /// Inverses of the diagonal blocks.
    pub inverses: &'a [[[f32; D]; D]],
    pub b: &'a [[f32; D]],
}

impl<const D: usize> Smoother<'_, D> {
    /// Forward sweep from x = 0, and the residual r = b − A x that it leaves: over the halves of a part side by side, then over its own rows.
    pub fn forward(&self, part: &Part, x: &mut [[f32; D]], r: &mut [[f32; D]]) {
        let first = part.rows.start;
        if let Some([left, right]) = part.halves.as_deref() {
            let middle = part.middle() - first;
            let ((x_left, x_right), (r_left, r_right)) = (x.split_at_mut(middle), r.split_at_mut(middle));
            join(|| self.forward(left, x_left, r_left), || self.forward(right, x_right, r_right));
        }
        vectorized(Forward { smoother: self, rows: part.own(), first, x, r });
    }

    /// Backward sweep from x: over the own rows of a part, then over its halves side by side. `above` is workspace, zero before and after.
    pub fn backward(&self, part: &Part, x: &mut [[f32; D]], above: &mut [[f32; D]]) {
        let first = part.rows.start;
        vectorized(Backward { smoother: self, rows: part.own(), first, x, above });
        if let Some([left, right]) = part.halves.as_deref() {
            let middle = part.middle() - first;
            let ((x_left, x_right), (above_left, above_right)) = (x.split_at_mut(middle), above.split_at_mut(middle));
            join(|| self.backward(left, x_left, above_left), || self.backward(right, x_right, above_right));
        }
    }
}

/// Some rows of a forward sweep.
struct Forward<'a, const D: usize> {
    smoother: &'a Smoother<'a, D>,
    rows: Range<usize>,
    /// The first row of the vectors below.
    first: usize,
    x: &'a mut [[f32; D]],
    r: &'a mut [[f32; D]],
}

impl<const D: usize> WithSimd for Forward<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { smoother: &Smoother { A, diagonal, inverses, b }, rows, first, x, r } = self;
        for row in rows {
            let before = A.starts[row]..diagonal[row];
            let (columns, values) = (&A.columns[before.clone()], &A.values[before]);
            let product = sum_products(columns, values, first, x);
            let solved = times(&inverses[row], &std::array::from_fn(|i| b[row][i] - product[i]));
            // The row itself is solved for; blocks right of the diagonal, which met zeros, leave the residual.
            (x[row - first], r[row - first]) = (solved, [0.0; D]);
            let negative = solved.map(|x| -x);
            for (&column, block) in columns.iter().zip(values) {
                add_transposed(block, &negative, &mut r[column as usize - first]);
            }
        }
    }
}

/// Some rows of a backward sweep.
struct Backward<'a, const D: usize> {
    smoother: &'a Smoother<'a, D>,
    rows: Range<usize>,
    /// The first row of the vectors below.
    first: usize,
    x: &'a mut [[f32; D]],
    /// Blocks right of the diagonal times x, as far as the sweep has come.
    above: &'a mut [[f32; D]],
}

impl<const D: usize> WithSimd for Backward<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { smoother: &Smoother { A, diagonal, inverses, b }, rows, first, x, above } = self;
        for row in rows.rev() {
            let blocks = A.starts[row]..=diagonal[row];
            let (columns, values) = (&A.columns[blocks.clone()], &A.values[blocks]);
            let (product, above_row) =
                (sum_products(columns, values, first, x), std::mem::replace(&mut above[row - first], [0.0; D]));
            let residual = std::array::from_fn(|i| b[row][i] - product[i] - above_row[i]);
            let change = times(&inverses[row], &residual);
            let x_row = std::array::from_fn(|i| x[row - first][i] + change[i]);
            x[row - first] = x_row;
            for (&column, block) in columns.iter().zip(values).take(columns.len() - 1) {
                add_transposed(block, &x_row, &mut above[column as usize - first]);
            }
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
