//! Dense kernels on column-major matrices: entry (i, j) is at `j * stride + i`, and strides are whole numbers of registers.
//!
//! The number of columns is a multiple of three, so kernels process six columns at a time, or three at the end.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use crate::solvers::block::sqrt_pivot;
use fem_elements::number::Float;
use fem_elements::number::Packed;
use fem_model::simulation::Breakdown;

/// Columns that a kernel processes together.
const AT_ONCE: usize = 6;

/// Rows that are processed through all columns before the next ones, so that they stay in the cache.
const ROWS: usize = 64;

/// Columns that are factorised before the update of those after them.
const COLUMNS: usize = 48;

/// C = C − A Bᵀ or C = −A Bᵀ on and below the diagonal. Entries above it become meaningless.
pub struct Products<'a, T> {
    /// Columns of C, from its first row on.
    pub C: &'a mut [T],
    pub stride_C: usize,
    /// `depth` columns, from the row that corresponds to C's first row.
    pub A: &'a [T],
    /// The same columns, from the row that corresponds to C's first column.
    pub B: &'a [T],
    pub stride_A: usize,
    pub depth: usize,
    /// Rows of C, a whole number of registers.
    pub rows: usize,
    /// Columns of C, a multiple of three.
    pub columns: usize,
    /// Row of the first column's diagonal entry.
    pub diagonal: usize,
    /// C = −A Bᵀ is computed: C is not read.
    pub fresh: bool,
}

impl<T: Float> WithSimd for Products<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let lanes = lanes::<T, S>();
        for block in (0..self.rows).step_by(ROWS) {
            let end = (block + ROWS).min(self.rows);
            let mut column = 0;
            while column < self.columns && self.diagonal + column < end {
                let row = block.max((self.diagonal + column) / lanes * lanes);
                if column + AT_ONCE <= self.columns {
                    self.strip::<S, AT_ONCE>(simd, row..end, column);
                    column += AT_ONCE;
                } else {
                    self.strip::<S, 3>(simd, row..end, column);
                    column += 3;
                }
            }
        }
    }
}

impl<T: Float> Products<'_, T> {
    /// N columns of some rows.
    #[inline(always)]
    fn strip<S: Simd, const N: usize>(&mut self, simd: S, rows: Range<usize>, column: usize) {
        let lanes = lanes::<T, S>();
        let mut row = rows.start;
        if S::REGISTER_COUNT > 16 {
            while row + 4 * lanes <= rows.end {
                self.tile::<S, 4, N>(simd, row, column);
                row += 4 * lanes;
            }
        }
        while row + 2 * lanes <= rows.end {
            self.tile::<S, 2, N>(simd, row, column);
            row += 2 * lanes;
        }
        if row < rows.end {
            self.tile::<S, 1, N>(simd, row, column);
        }
    }

    /// N columns of R registers of rows.
    #[inline(always)]
    fn tile<S: Simd, const R: usize, const N: usize>(&mut self, simd: S, row: usize, column: usize) {
        let rows = R * lanes::<T, S>();
        let zero = T::broadcast(simd, T::default());
        let mut sums = [[zero; R]; N];
        for k in 0..self.depth {
            let a = T::packs::<S>(&self.A[k * self.stride_A + row..][..rows]);
            let b = &self.B[k * self.stride_A + column..][..N];
            for n in 0..N {
                let b = T::broadcast(simd, b[n]);
                for r in 0..R {
                    sums[n][r] = T::multiply_add(simd, a[r], b, sums[n][r]);
                }
            }
        }
        for (n, sums) in sums.iter().enumerate() {
            let c = T::packs_mut::<S>(&mut self.C[(column + n) * self.stride_C + row..][..rows]);
            for r in 0..R {
                c[r] = T::subtract(simd, if self.fresh { zero } else { c[r] }, sums[r]);
            }
        }
    }
}

/// Solves X Lᵀ = C for a lower triangular L of N columns; X overwrites C.
struct Divide<'a, T, const N: usize> {
    C: &'a mut [T],
    stride: usize,
    L: &'a [[T; N]; N],
    /// 1 / diagonal of L
    inverse: &'a [T; N],
    rows: usize,
}

impl<T: Packed, const N: usize> WithSimd for Divide<'_, T, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let lanes = lanes::<T, S>();
        // Loops: the compiler does not always inline `map` of arrays, and registers would go through memory.
        let any = T::broadcast(simd, self.inverse[0]);
        let (mut L, mut inverse) = ([[any; N]; N], [any; N]);
        for n in 0..N {
            inverse[n] = T::broadcast(simd, self.inverse[n]);
            for k in 0..n {
                L[n][k] = T::broadcast(simd, self.L[n][k]);
            }
        }
        for row in (0..self.rows).step_by(lanes) {
            let mut x = inverse;
            for n in 0..N {
                let c = &mut T::packs_mut::<S>(&mut self.C[n * self.stride + row..][..lanes])[0];
                let mut sum = T::multiply(simd, *c, inverse[n]);
                for k in 0..n {
                    sum = T::subtract(simd, sum, T::multiply(simd, x[k], L[n][k]));
                }
                x[n] = sum;
                *c = sum;
            }
        }
    }
}

/// Factorises the first columns of a symmetric matrix, one for each entry of `inverse`, given their lower part: L overwrites
/// them. In the register of its diagonal entry a column of L is zero above the diagonal; entries farther up are meaningless.
///
/// On entry `inverse` holds the diagonal of the sparse matrix, on return 1 / diagonal of L.
pub fn factor_columns<T: Float, S: Simd>(
    simd: S,
    columns: &mut [T],
    stride: usize,
    inverse: &mut [T],
) -> Result<(), Breakdown> {
    let width = inverse.len();
    for start in (0..width).step_by(COLUMNS) {
        let end = (start + COLUMNS).min(width);
        let mut first = start;
        while first < end {
            let count = if first + AT_ONCE <= end { AT_ONCE } else { 3 };
            subtract_columns(simd, columns, stride, start..first, first..first + count);
            let C = &mut columns[first * stride..];
            let inverse = &mut inverse[first..first + count];
            match count {
                AT_ONCE => factor_block::<T, S, AT_ONCE>(simd, C, stride, first, inverse)?,
                _ => factor_block::<T, S, 3>(simd, C, stride, first, inverse)?,
            }
            first += count;
        }
        subtract_columns(simd, columns, stride, start..end, end..width);
    }
    Ok(())
}

/// Subtracts the contribution of the columns `done` from the columns `next`.
fn subtract_columns<T: Float, S: Simd>(
    simd: S,
    columns: &mut [T],
    stride: usize,
    done: Range<usize>,
    next: Range<usize>,
) {
    if done.is_empty() || next.is_empty() {
        return;
    }
    let (before, C) = columns.split_at_mut(next.start * stride);
    simd.vectorize(Products {
        C,
        stride_C: stride,
        A: &before[done.start * stride..],
        B: &before[done.start * stride + next.start..],
        stride_A: stride,
        depth: done.len(),
        rows: stride,
        columns: next.len(),
        diagonal: next.start,
        fresh: false,
    });
}

/// Factorises N columns, of which the first has its diagonal entry in row `first`.
fn factor_block<T: Float, S: Simd, const N: usize>(
    simd: S,
    C: &mut [T],
    stride: usize,
    first: usize,
    inverse: &mut [T],
) -> Result<(), Breakdown> {
    // Registers begin at the same rows in all columns.
    let from = first / <T as Float>::MAX_WIDTH * <T as Float>::MAX_WIDTH;
    let mut L = [[T::default(); N]; N];
    let mut inverses = [T::default(); N];
    for j in 0..N {
        let column = &C[j * stride + first..][..N];
        for i in j..N {
            let mut entry = column[i];
            for k in 0..j {
                entry -= L[i][k] * L[j][k];
            }
            if i == j {
                L[j][j] = sqrt_pivot(entry, inverse[j])?;
                inverses[j] = T::one() / L[j][j];
            } else {
                L[i][j] = entry * inverses[j];
            }
        }
    }
    inverse.copy_from_slice(&inverses);
    // The rows of L divided by its diagonal: X_n = C_n / L_nn − Σ X_k L_nk / L_nn
    let mut divided = L;
    for n in 0..N {
        for k in 0..n {
            divided[n][k] *= inverses[n];
        }
    }
    simd.vectorize(Divide { C: &mut C[from..], stride, L: &divided, inverse: &inverses, rows: stride - from });
    for j in 0..N {
        C[j * stride + from..][..first + j - from].fill(T::default());
    }
    Ok(())
}

/// Number of scalars in a register.
#[inline(always)]
pub fn lanes<T: Packed, S: Simd>() -> usize {
    size_of::<T::Pack<S>>() / size_of::<T>()
}
