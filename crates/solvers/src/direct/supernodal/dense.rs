//! The factorisation of the columns of a front, a column-major matrix: entry (i, j) is at `j * stride + i`, and strides are whole numbers of
//! registers.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::products::{AT_ONCE, Products, at_once, lanes};
use crate::block::sqrt_pivot;
use fem_elements::number::Float;
use fem_elements::number::Packed;
use fem_model::simulation::Breakdown;

/// Columns that are factorised before the update of those of the panel after them.
const COLUMNS: usize = 48;

/// Columns of a panel, which is factorised before the update of all columns after it.
const PANEL: usize = 240;

/// Solves X Lᵀ = C for a lower triangular L of N columns; X overwrites C.
pub struct Divide<'a, T, const N: usize> {
    pub C: &'a mut [T],
    pub stride: usize,
    /// The rows of L divided by its diagonal.
    pub L: &'a [[T; N]; N],
    /// 1 / diagonal of L
    pub inverse: &'a [T; N],
    pub rows: usize,
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

/// The pivots of a factor: A = L S Lᵀ, where S is diagonal with entries 1 or −1, and all are 1 if A is positive definite.
pub struct Pivots<'a, T> {
    /// The diagonal of the matrix, and after the factorisation 1 / diagonal of L.
    pub inverse: &'a mut [T],
    /// The diagonal of S; empty where the matrix has to be positive definite.
    pub signs: &'a mut [T],
}

/// Factorises the first columns of a symmetric matrix, one for each pivot, given their lower part: L overwrites
/// them. In the register of its diagonal entry a column of L is zero above the diagonal; entries farther up are meaningless.
pub fn factor_columns<T: Float, S: Simd, const SIGNED: bool>(
    simd: S,
    columns: &mut [T],
    stride: usize,
    pivots: &mut Pivots<T>,
) -> Result<(), Breakdown> {
    let width = pivots.inverse.len();
    for panel in (0..width).step_by(PANEL) {
        let panel = panel..(panel + PANEL).min(width);
        for start in panel.clone().step_by(COLUMNS) {
            let end = (start + COLUMNS).min(panel.end);
            let mut first = start;
            while first < end {
                let next = first..first + at_once(end - first);
                subtract_columns::<T, S, SIGNED>(simd, columns, stride, start..first, next.clone(), pivots.signs);
                let C = &mut columns[first * stride..];
                match next.len() {
                    AT_ONCE => factor_block::<T, S, AT_ONCE, SIGNED>(simd, C, stride, first, pivots)?,
                    3 => factor_block::<T, S, 3, SIGNED>(simd, C, stride, first, pivots)?,
                    _ => factor_block::<T, S, 1, SIGNED>(simd, C, stride, first, pivots)?,
                }
                first = next.end;
            }
            subtract_columns::<T, S, SIGNED>(simd, columns, stride, start..end, end..panel.end, pivots.signs);
        }
        subtract_columns::<T, S, SIGNED>(simd, columns, stride, panel.clone(), panel.end..width, pivots.signs);
    }
    Ok(())
}

/// Subtracts the contribution of the columns `done` from the columns `next`.
fn subtract_columns<T: Float, S: Simd, const SIGNED: bool>(
    simd: S,
    columns: &mut [T],
    stride: usize,
    done: Range<usize>,
    next: Range<usize>,
    signs: &[T],
) {
    if done.is_empty() || next.is_empty() {
        return;
    }
    let (before, C) = columns.split_at_mut(next.start * stride);
    let products = Products::<T, SIGNED> {
        C,
        stride_C: stride,
        A: &before[done.start * stride..],
        B: &before[done.start * stride + next.start..],
        stride_A: stride,
        stride_B: stride,
        depth: done.len(),
        signs: if SIGNED { &signs[done] } else { &[] },
        rows: stride,
        columns: next.len(),
        diagonal: next.start,
        fresh: false,
    };
    products.compute(simd);
}

/// Factorises N columns, of which the first has its diagonal entry in row `first`.
fn factor_block<T: Float, S: Simd, const N: usize, const SIGNED: bool>(
    simd: S,
    C: &mut [T],
    stride: usize,
    first: usize,
    pivots: &mut Pivots<T>,
) -> Result<(), Breakdown> {
    // Registers begin at the same rows in all columns.
    let from = first / <T as Float>::MAX_WIDTH * <T as Float>::MAX_WIDTH;
    let inverse = &mut pivots.inverse[first..first + N];
    let mut L = [[T::default(); N]; N];
    let (mut inverses, mut signs) = ([T::default(); N], [T::one(); N]);
    for j in 0..N {
        let column = &C[j * stride + first..][..N];
        for i in j..N {
            let mut entry = column[i];
            for k in 0..j {
                entry -= if SIGNED { L[i][k] * L[j][k] * signs[k] } else { L[i][k] * L[j][k] };
            }
            if i > j {
                L[i][j] = entry * inverses[j];
                continue;
            }
            (L[j][j], signs[j]) = if SIGNED { signed_root(entry)? } else { (sqrt_pivot(entry, inverse[j])?, T::one()) };
            // Off the diagonal entries of A are those of L S times L's diagonal.
            inverses[j] = if SIGNED { signs[j] / L[j][j] } else { T::one() / L[j][j] };
        }
    }
    // The rows of L divided by its diagonal: X_n = S_n (C_n − Σ S_k X_k L_nk) / L_nn
    let mut divided = L;
    for n in 0..N {
        for k in 0..n {
            divided[n][k] *= if SIGNED { signs[k] * inverses[n] } else { inverses[n] };
        }
    }
    simd.vectorize(Divide { C: &mut C[from..], stride, L: &divided, inverse: &inverses, rows: stride - from });
    for j in 0..N {
        C[j * stride + from..][..first + j - from].fill(T::default());
        inverse[j] = if SIGNED { signs[j] * inverses[j] } else { inverses[j] };
    }
    if SIGNED {
        pivots.signs[first..first + N].copy_from_slice(&signs);
    }
    Ok(())
}

/// √|pivot| and the sign of the pivot.
fn signed_root<T: Float>(pivot: T) -> Result<(T, T), Breakdown> {
    match pivot.abs().sqrt() {
        root if root > T::default() && root.is_finite() => {
            Ok((root, if pivot > T::default() { T::one() } else { -T::one() }))
        }
        _ => Err(Breakdown::Singular),
    }
}
