//! Products of a symmetric block matrix with vectors, whether all of its blocks are stored or its lower half.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use crate::parts::Part;
use fem_elements::Real;
use fem_elements::number::vectorized;
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_elements::threads::{join, over_parts};

/// From this many rows on several threads share the rows. For fewer rows, waking the threads costs more than they save.
const ROWS_FOR_THREADS: usize = 3000;

/// Rows that a thread processes at a time.
const CHUNK: usize = 1024;

/// The parts of a matrix of which the lower half is stored; all rows are one part otherwise, because threads can share them anyway.
pub fn parts(pattern: &Pattern) -> Part {
    match pattern.stored {
        Stored::Lower => Part::new(pattern.rows(), |row| &pattern.columns[pattern.row(row)]),
        Stored::Full => Part::whole(pattern.rows()),
    }
}

/// y = A x for a matrix with these [`parts`]. The sums of a row are added in the same order with any number of threads.
pub fn product<T: Real>(pattern: &Pattern, parts: &Part, values: &[Block<T, 3>], x: &[[T; 3]], y: &mut [[T; 3]]) {
    let y = &mut y[..pattern.rows()];
    match pattern.stored {
        Stored::Lower => Lower { pattern, values, x, first: 0, y }.multiply(parts),
        Stored::Full if y.len() < ROWS_FOR_THREADS => vectorized(Rows { pattern, values, x, first: 0, y }),
        Stored::Full => over_parts(y, CHUNK, &|first, y| vectorized(Rows { pattern, values, x, first, y })),
    }
}

/// Some rows of a product, from `first` on.
struct Rows<'a, T> {
    pattern: &'a Pattern,
    values: &'a [Block<T, 3>],
    x: &'a [[T; 3]],
    first: usize,
    y: &'a mut [[T; 3]],
}

impl<T: Real> WithSimd for Rows<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        for (row, y) in self.y.iter_mut().enumerate() {
            let blocks = self.pattern.row(self.first + row);
            // Each entry of a block has a sum of its own, so that no addition waits for another.
            let mut sums = [[T::default(); 3]; 3];
            for (block, &column) in self.values[blocks.clone()].iter().zip(&self.pattern.columns[blocks]) {
                let x = &self.x[column as usize];
                for i in 0..3 {
                    for j in 0..3 {
                        sums[i][j] += block[i][j] * x[j];
                    }
                }
            }
            *y = sums.map(|sums| sums[0] + sums[1] + sums[2]);
        }
    }
}

/// Consecutive rows of the product of a matrix of which the lower half is stored, from `first` on: a block below the diagonal
/// represents its transpose above it as well.
struct Lower<'a, T> {
    pattern: &'a Pattern,
    values: &'a [Block<T, 3>],
    x: &'a [[T; 3]],
    first: usize,
    y: &'a mut [[T; 3]],
}

impl<T: Real> Lower<'_, T> {
    /// Multiplies the rows of a part: its halves side by side, then its own.
    fn multiply(mut self, part: &Part) {
        if let Some([left, right]) = part.halves.as_deref() {
            let Self { pattern, values, x, first, ref mut y } = self;
            let (y_left, rest) = y.split_at_mut(left.rows.len());
            let y_right = &mut rest[..right.rows.len()];
            join(
                || Lower { pattern, values, x, first, y: y_left }.multiply(left),
                || Lower { pattern, values, x, first: right.rows.start, y: y_right }.multiply(right),
            );
        }
        vectorized(LowerRows { rows: part.own(), all: self });
    }
}

/// Some rows, whose blocks are in columns of rows that are multiplied before.
struct LowerRows<'a, T> {
    rows: Range<usize>,
    all: Lower<'a, T>,
}

impl<T: Real> WithSimd for LowerRows<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Lower { pattern, values, x, first, y } = self.all;
        for row in self.rows {
            let blocks = pattern.row(row);
            let Some(diagonal) = blocks.end.checked_sub(1) else { continue };
            let (x_row, mut sum) = (x[row], [T::default(); 3]);
            add_product(&values[diagonal], &x_row, &mut sum);
            for block in blocks.start..diagonal {
                let (column, value) = (pattern.columns[block] as usize, &values[block]);
                add_product(value, &x[column], &mut sum);
                let above = &mut y[column - first];
                for i in 0..3 {
                    above[i] += value[0][i] * x_row[0] + value[1][i] * x_row[1] + value[2][i] * x_row[2];
                }
            }
            y[row - first] = sum;
        }
    }
}

/// y += A x for one block.
#[inline(always)]
fn add_product<T: Real>(A: &Block<T, 3>, x: &[T; 3], y: &mut [T; 3]) {
    for i in 0..3 {
        for j in 0..3 {
            y[i] += A[i][j] * x[j];
        }
    }
}
