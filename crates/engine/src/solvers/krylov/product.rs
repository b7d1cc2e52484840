//! Products of a symmetric block matrix with vectors, whether all of its blocks are stored or its lower half.

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use crate::number::{Real, vectorized};
use crate::sparse::{Block, Pattern, Stored};

/// From this many rows on several threads share the rows. For fewer rows, waking the threads costs more than they save.
const ROWS_FOR_THREADS: usize = 20_000;

/// Rows that a thread processes at a time.
const CHUNK: usize = 1024;

/// y = A x. One thread sums up a row, so the result does not depend on the number of threads.
pub fn product<T: Real>(pattern: &Pattern, values: &[Block<T, 3>], x: &[[T; 3]], y: &mut [[T; 3]]) {
    let y = &mut y[..pattern.rows()];
    match pattern.stored {
        Stored::Lower => lower(pattern, values, x, y),
        Stored::Full if y.len() < ROWS_FOR_THREADS => vectorized(Rows { pattern, values, x, first: 0, y }),
        Stored::Full => y.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, y)| {
            vectorized(Rows { pattern, values, x, first: chunk * CHUNK, y });
        }),
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

/// y = A x for a matrix of which the lower half is stored: a block below the diagonal represents its transpose above it as
/// well.
fn lower<T: Real>(pattern: &Pattern, values: &[Block<T, 3>], x: &[[T; 3]], y: &mut [[T; 3]]) {
    y.fill([T::default(); 3]);
    for row in 0..pattern.rows() {
        let blocks = pattern.row(row);
        let Some(diagonal) = blocks.end.checked_sub(1) else { continue };
        let x_row = x[row];
        let mut sum = y[row];
        add_product(&values[diagonal], &x_row, &mut sum);
        for block in blocks.start..diagonal {
            let (column, value) = (pattern.columns[block] as usize, &values[block]);
            add_product(value, &x[column], &mut sum);
            let above = &mut y[column];
            for i in 0..3 {
                above[i] += value[0][i] * x_row[0] + value[1][i] * x_row[1] + value[2][i] * x_row[2];
            }
        }
        y[row] = sum;
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

#[cfg(test)]
mod tests {
    use super::product;
    use crate::solvers::beam::{Beam, random};
    use crate::sparse::{Pattern, Stored};

    #[test]
    fn a_product_sums_blocks_times_nodes() {
        let pattern = Pattern::new(2, &[[0, 1]], Stored::Full);
        let scaled = |a: f64| [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
        let values = [[[1.0, 2.0, 0.0], [3.0, 4.0, 0.0], [0.0, 0.0, 1.0]], scaled(0.5), [[0.0; 3]; 3], scaled(2.0)];
        let mut y = [[0.0; 3]; 2];
        product(&pattern, &values, &[[1.0, 1.0, 3.0], [2.0, 4.0, -2.0]], &mut y);
        assert_eq!(y, [[4.0, 9.0, 2.0], [4.0, 8.0, -4.0]]);
    }

    #[test]
    fn full_and_lower_storage_give_the_same_product() {
        let (full, lower) = (Beam::new(4, Stored::Full), Beam::new(4, Stored::Lower));
        let x = random::<f64>(full.pattern.rows(), 1);
        let (mut y, mut z) = (vec![[0.0; 3]; x.len()], vec![[f64::NAN; 3]; x.len()]);
        product(&full.pattern, &full.values(), &x, &mut y);
        product(&lower.pattern, &lower.values(), &x, &mut z);
        for (y, z) in y.as_flattened().iter().zip(z.as_flattened()) {
            approx::assert_relative_eq!(y, z, max_relative = 1e-9, epsilon = 1e-6);
        }
    }
}
