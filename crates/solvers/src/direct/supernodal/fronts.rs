//! The LU factorisation of the columns of a front.

use std::ops::Range;

use pulp::Simd;

use super::dense::Divide;
use super::products::{AT_ONCE, Products, at_once};
use fem_elements::number::Float;
use fem_model::simulation::Breakdown;

/// Rows and columns of a diagonal block, in which pivots are sought: a multiple of [`AT_ONCE`].
const BLOCK: usize = 48;

/// The columns of L and of Uᵀ of a front. Before the factorisation they are those of the lower half of the matrix, with the diagonal, and of
/// the transposed upper half.
pub struct Front<'a, T> {
    pub L: &'a mut [T],
    pub U: &'a mut [T],
    pub stride: usize,
    /// 1 / diagonal of U.
    pub inverse: &'a mut [T],
    /// The row with which each row was exchanged, one after the other.
    pub swaps: &'a mut [u32],
}

/// A diagonal block, row by row.
type Square<T> = [[T; BLOCK]; BLOCK];

/// Factorises the first columns, one for each entry of `inverse`. The diagonal of L is 1.
pub fn factor_front<T: Float, S: Simd>(simd: S, front: &mut Front<T>) -> Result<(), Breakdown> {
    let width = front.inverse.len();
    for start in (0..width).step_by(BLOCK) {
        let rows = start..(start + BLOCK).min(width);
        let mut square = front.square(&rows);
        factor_square(&mut square, rows.len(), &mut front.swaps[rows.clone()])?;
        front.exchange(&rows);
        let mut transposed = [[T::default(); BLOCK]; BLOCK];
        for (i, row) in square.iter().enumerate() {
            (0..BLOCK).for_each(|j| transposed[j][i] = row[j]);
        }
        // The columns of L times U, and those of Uᵀ times Lᵀ, are what is left of the matrix.
        let inverse = std::array::from_fn(|i| if i < rows.len() { T::one() / square[i][i] } else { T::one() });
        front.inverse[rows.clone()].copy_from_slice(&inverse[..rows.len()]);
        divide(simd, front.L, front.stride, &rows, &square, &inverse);
        divide(simd, front.U, front.stride, &rows, &transposed, &[T::one(); BLOCK]);
        front.place(&rows, &square);
        subtract(simd, front.L, front.U, front.stride, &rows, width);
        subtract(simd, front.U, front.L, front.stride, &rows, width);
    }
    Ok(())
}

impl<T: Float> Front<'_, T> {
    /// The diagonal block of these rows.
    fn square(&self, rows: &Range<usize>) -> Square<T> {
        let mut square = [[T::default(); BLOCK]; BLOCK];
        for i in 0..rows.len() {
            for j in 0..rows.len() {
                let (of, row, column) = if i >= j { (&self.L, i, j) } else { (&self.U, j, i) };
                square[i][j] = of[(rows.start + column) * self.stride + rows.start + row];
            }
        }
        square
    }

    /// Exchanges rows outside the diagonal block as its own rows were.
    fn exchange(&mut self, rows: &Range<usize>) {
        for i in rows.clone() {
            self.swaps[i] += rows.start as u32;
            let other = self.swaps[i] as usize;
            if other == i {
                continue;
            }
            for column in self.L[..rows.start * self.stride].chunks_exact_mut(self.stride) {
                column.swap(i, other);
            }
            let (before, after) = self.U.split_at_mut(other * self.stride);
            before[i * self.stride..][rows.end..self.stride].swap_with_slice(&mut after[rows.end..self.stride]);
        }
    }

    /// Writes a factorised diagonal block. In the register of its diagonal entry a column is zero above that.
    fn place(&mut self, rows: &Range<usize>, square: &Square<T>) {
        let from = rows.start / <T as Float>::MAX_WIDTH * <T as Float>::MAX_WIDTH;
        for j in 0..rows.len() {
            let column = (rows.start + j) * self.stride;
            for of in [&mut *self.L, &mut *self.U] {
                of[column + from..column + rows.start + j].fill(T::default());
            }
            self.L[column + rows.start + j] = T::one();
            self.U[column + rows.start + j] = square[j][j];
            for i in j + 1..rows.len() {
                self.L[column + rows.start + i] = square[i][j];
                self.U[column + rows.start + i] = square[j][i];
            }
        }
    }
}

/// P A = L U with partial pivoting; L without its diagonal and U overwrite A.
fn factor_square<T: Float>(A: &mut Square<T>, rows: usize, swaps: &mut [u32]) -> Result<(), Breakdown> {
    for k in 0..rows {
        let mut pivot = k;
        for i in k + 1..rows {
            if A[i][k].abs() > A[pivot][k].abs() {
                pivot = i;
            }
        }
        A.swap(k, pivot);
        swaps[k] = pivot as u32;
        let (done, rest) = A[..rows].split_at_mut(k + 1);
        let of_pivot = &done[k];
        if of_pivot[k] == T::default() || !of_pivot[k].is_finite() {
            return Err(Breakdown::Singular);
        }
        let inverse = T::one() / of_pivot[k];
        for row in rest {
            row[k] *= inverse;
            let factor = row[k];
            for j in k + 1..BLOCK {
                row[j] -= factor * of_pivot[j];
            }
        }
    }
    Ok(())
}

/// Solves X R = C below a diagonal block for its columns, R being upper triangular with this inverse diagonal; X overwrites C.
fn divide<T: Float, S: Simd>(
    simd: S,
    columns: &mut [T],
    stride: usize,
    block: &Range<usize>,
    R: &Square<T>,
    inverse: &[T; BLOCK],
) {
    // The first of these rows belong to the block: registers begin at the same rows in all columns. They are set afterwards.
    let from = block.end / <T as Float>::MAX_WIDTH * <T as Float>::MAX_WIDTH;
    if from == stride {
        return;
    }
    let mut first = 0;
    while first < block.len() {
        let (before, C) = columns.split_at_mut((block.start + first) * stride);
        let count = at_once(block.len() - first);
        if first > 0 {
            let products = Products::<T, false> {
                C: &mut C[from..],
                stride_C: stride,
                A: &before[block.start * stride + from..],
                B: &R.as_flattened()[first..],
                stride_A: stride,
                stride_B: BLOCK,
                depth: first,
                signs: &[],
                rows: stride - from,
                columns: count,
                diagonal: 0,
                fresh: false,
            };
            products.compute(simd);
        }
        match count {
            AT_ONCE => divide_block::<T, S, AT_ONCE>(simd, &mut C[from..], stride, stride - from, R, inverse, first),
            _ => divide_block::<T, S, 3>(simd, &mut C[from..], stride, stride - from, R, inverse, first),
        }
        first += count;
    }
}

/// The same for N columns, from the given one of the block on.
fn divide_block<T: Float, S: Simd, const N: usize>(
    simd: S,
    C: &mut [T],
    stride: usize,
    rows: usize,
    R: &Square<T>,
    inverse: &[T; BLOCK],
    first: usize,
) {
    let (mut L, mut inverses) = ([[T::default(); N]; N], [T::default(); N]);
    for n in 0..N {
        inverses[n] = inverse[first + n];
        for k in 0..n {
            L[n][k] = R[first + k][first + n] * inverses[n];
        }
    }
    simd.vectorize(Divide { C, stride, L: &L, inverse: &inverses, rows });
}

/// Subtracts the contribution of a block of columns from those after it: C = C − X Yᵀ.
fn subtract<T: Float, S: Simd>(simd: S, C: &mut [T], Y: &[T], stride: usize, block: &Range<usize>, width: usize) {
    if block.end == width {
        return;
    }
    let (X, C) = C.split_at_mut(block.end * stride);
    let products = Products::<T, false> {
        C,
        stride_C: stride,
        A: &X[block.start * stride..],
        B: &Y[block.start * stride + block.end..],
        stride_A: stride,
        stride_B: stride,
        depth: block.len(),
        signs: &[],
        rows: stride,
        columns: width - block.end,
        diagonal: block.end,
        fresh: false,
    };
    products.compute(simd);
}
