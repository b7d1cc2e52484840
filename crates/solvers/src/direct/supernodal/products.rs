//! The product of panels that nearly all of a factorisation's time goes into, C = C − A S Bᵀ, on column-major matrices: entry (i, j) is at
//! `j * stride + i`, and strides are whole numbers of registers.
//!
//! Large products copy a block of A and a few columns of B to where they are read one after the other: Goto and van de Geijn, Anatomy of
//! High-Performance Matrix Multiplication (2008). Several threads share them by columns of C, so that no entry depends on their number.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use fem_elements::number::Float;
use fem_elements::number::Packed;
use fem_elements::threads::join;

/// Columns that a kernel processes together. A matrix whose number of columns is a multiple of three ends with three, others with single ones.
pub const AT_ONCE: usize = 6;

/// Rows that are processed through all columns before the next ones, so that they stay in the cache.
const ROWS: usize = 64;

/// Columns of A and B that are copied together, and columns of C that are updated with them.
const DEPTH: usize = 128;
const COLUMNS: usize = 192;

/// Smallest depth, and smallest number of multiplications, of products for which panels are copied.
const COPIED_DEPTH: usize = 64;
const COPIED: usize = 1 << 24;

/// C = C − A S Bᵀ or C = −A S Bᵀ on and below the diagonal. Entries above it become meaningless.
pub struct Products<'a, T, const SIGNED: bool> {
    /// Columns of C, from its first row on.
    pub C: &'a mut [T],
    pub stride_C: usize,
    /// `depth` columns, from the row that corresponds to C's first row.
    pub A: &'a [T],
    /// The same columns, from the row that corresponds to C's first column.
    pub B: &'a [T],
    pub stride_A: usize,
    pub stride_B: usize,
    pub depth: usize,
    /// The diagonal of S, 1 or −1 for each of these columns; not read, and S = 1, unless `SIGNED`.
    pub signs: &'a [T],
    /// Rows of C, a whole number of registers.
    pub rows: usize,
    pub columns: usize,
    /// Row of the first column's diagonal entry.
    pub diagonal: usize,
    /// C = −A S Bᵀ is computed: C is not read.
    pub fresh: bool,
}

impl<T: Float, const SIGNED: bool> Products<'_, T, SIGNED> {
    /// Computes the product, with copies and shared by threads if it is large.
    pub fn compute<S: Simd>(self, simd: S) {
        if self.depth < COPIED_DEPTH || self.columns < COLUMNS / 2 || self.multiplications() < COPIED {
            simd.vectorize(InPlace(self));
        } else {
            self.share(simd);
        }
    }

    /// Divides the columns among threads.
    fn share<S: Simd>(self, simd: S) {
        if self.columns < 2 * COLUMNS {
            return simd.vectorize(Copied(self));
        }
        let (left, right) = self.halves();
        join(|| left.share(simd), || right.share(simd));
    }

    fn multiplications(&self) -> usize {
        let longest = self.rows - self.diagonal;
        self.depth * self.columns * (2 * longest - self.columns.min(longest)) / 2
    }

    /// Two products of about the same size, of the first columns and of the last.
    fn halves(self) -> (Self, Self) {
        // The first m columns of n have m (r − m/2) of the n (r − n/2) entries.
        let (r, n) = ((self.rows - self.diagonal) as f64, self.columns as f64);
        let middle = r - (r * r - n * (r - n / 2.0)).max(0.0).sqrt();
        let columns = ((middle as usize).next_multiple_of(AT_ONCE)).min(self.columns - 1);
        let (left, right) = self.C.split_at_mut(columns * self.stride_C);
        let first = Products { C: left, columns, ..self };
        let diagonal = self.diagonal + columns;
        let last = Products { C: right, B: &self.B[columns..], columns: self.columns - columns, diagonal, ..self };
        (first, last)
    }
}

/// A product that reads A and B where they are.
struct InPlace<'a, T, const SIGNED: bool>(Products<'a, T, SIGNED>);

/// A product that copies A and B first. A type of its own: only its function needs room for them.
struct Copied<'a, T, const SIGNED: bool>(Products<'a, T, SIGNED>);

impl<T: Float, const SIGNED: bool> WithSimd for InPlace<'_, T, SIGNED> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        self.0.in_place(simd);
    }
}

impl<T: Float, const SIGNED: bool> WithSimd for Copied<'_, T, SIGNED> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        self.0.copied(simd);
    }
}

impl<T: Float, const SIGNED: bool> Products<'_, T, SIGNED> {
    /// Reads A and B where they are.
    #[inline(always)]
    fn in_place<S: Simd>(&mut self, simd: S) {
        let lanes = lanes::<T, S>();
        for block in (0..self.rows).step_by(ROWS) {
            let end = (block + ROWS).min(self.rows);
            let mut column = 0;
            while column < self.columns && self.diagonal + column < end {
                let from = block.max((self.diagonal + column) / lanes * lanes);
                let (A, B) = (&self.A[from..], &self.B[column..]);
                let of = Operands { A, stride_A: self.stride_A, B, stride_B: self.stride_B, signs: self.signs };
                column += self.strip::<S, SIGNED>(simd, of, from..end, column, self.depth, self.fresh);
            }
        }
    }

    /// Copies blocks of A and columns of B first.
    #[inline(always)]
    fn copied<S: Simd>(&mut self, simd: S) {
        let lanes = lanes::<T, S>();
        let (mut block_A, mut columns_B) = ([T::default(); ROWS * DEPTH], [T::default(); COLUMNS * DEPTH]);
        for first in (0..self.depth).step_by(DEPTH) {
            let depth = DEPTH.min(self.depth - first);
            let fresh = self.fresh && first == 0;
            for columns in (0..self.columns).step_by(COLUMNS) {
                let columns = columns..(columns + COLUMNS).min(self.columns);
                self.copy_columns(&mut columns_B, first..first + depth, columns.clone());
                let top = (self.diagonal + columns.start) / ROWS * ROWS;
                for block in (top..self.rows).step_by(ROWS) {
                    let end = (block + ROWS).min(self.rows);
                    self.copy_block(&mut block_A, first..first + depth, block..end);
                    let mut column = columns.start;
                    while column < columns.end && self.diagonal + column < end {
                        let from = block.max((self.diagonal + column) / lanes * lanes);
                        let B = &columns_B[(column - columns.start) * DEPTH..];
                        let A = &block_A[from - block..];
                        let of = Operands { A, stride_A: ROWS, B, stride_B: at_once(columns.end - column), signs: &[] };
                        column += self.strip::<S, false>(simd, of, from..end, column, depth, fresh);
                    }
                }
            }
        }
    }

    /// Copies these rows of A, column by column.
    fn copy_block(&self, block: &mut [T], depth: Range<usize>, rows: Range<usize>) {
        for (to, k) in block.chunks_exact_mut(ROWS).zip(depth) {
            to[..rows.len()].copy_from_slice(&self.A[k * self.stride_A..][rows.clone()]);
        }
    }

    /// Copies these columns of S Bᵀ, those that are processed together one row after the other.
    #[inline(always)]
    fn copy_columns(&self, copied: &mut [T], depth: Range<usize>, columns: Range<usize>) {
        for (place, k) in depth.enumerate() {
            let from = &self.B[k * self.stride_B..][columns.clone()];
            let sign = if SIGNED { self.signs[k] } else { T::one() };
            let mut column = 0;
            while column < from.len() {
                let count = at_once(from.len() - column);
                let to = &mut copied[column * DEPTH + place * count..][..count];
                let from = &from[column..][..count];
                for n in 0..count {
                    to[n] = if SIGNED { from[n] * sign } else { from[n] };
                }
                column += count;
            }
        }
    }

    /// Some rows of the next columns; returns the number of these.
    #[inline(always)]
    fn strip<S: Simd, const WITH_SIGNS: bool>(
        &mut self,
        simd: S,
        of: Operands<T>,
        rows: Range<usize>,
        column: usize,
        depth: usize,
        fresh: bool,
    ) -> usize {
        let C = &mut self.C[column * self.stride_C + rows.start..];
        let (stride, rows) = (self.stride_C, rows.len());
        match at_once(self.columns - column) {
            AT_ONCE => strip::<T, S, AT_ONCE, WITH_SIGNS>(simd, of, C, stride, rows, depth, fresh),
            3 => strip::<T, S, 3, WITH_SIGNS>(simd, of, C, stride, rows, depth, fresh),
            _ => strip::<T, S, 1, WITH_SIGNS>(simd, of, C, stride, rows, depth, fresh),
        }
        at_once(self.columns - column)
    }
}

/// Number of columns that are processed together, if so many are left.
#[inline(always)]
pub fn at_once(left: usize) -> usize {
    match left {
        AT_ONCE.. => AT_ONCE,
        3.. => 3,
        _ => 1,
    }
}

/// A from the first row on, and B from the first column on.
#[derive(Clone, Copy)]
struct Operands<'a, T> {
    A: &'a [T],
    stride_A: usize,
    B: &'a [T],
    stride_B: usize,
    signs: &'a [T],
}

/// N columns of some rows.
#[inline(always)]
fn strip<T: Float, S: Simd, const N: usize, const SIGNED: bool>(
    simd: S,
    of: Operands<T>,
    C: &mut [T],
    stride: usize,
    rows: usize,
    depth: usize,
    fresh: bool,
) {
    let lanes = lanes::<T, S>();
    let mut row = 0;
    if S::REGISTER_COUNT > 16 {
        while row + 4 * lanes <= rows {
            tile::<T, S, 4, N, SIGNED>(simd, of, &mut C[row..], stride, row, depth, fresh);
            row += 4 * lanes;
        }
    }
    while row + 2 * lanes <= rows {
        tile::<T, S, 2, N, SIGNED>(simd, of, &mut C[row..], stride, row, depth, fresh);
        row += 2 * lanes;
    }
    if row < rows {
        tile::<T, S, 1, N, SIGNED>(simd, of, &mut C[row..], stride, row, depth, fresh);
    }
}

/// N columns of R registers of rows.
#[inline(always)]
fn tile<T: Float, S: Simd, const R: usize, const N: usize, const SIGNED: bool>(
    simd: S,
    of: Operands<T>,
    C: &mut [T],
    stride: usize,
    row: usize,
    depth: usize,
    fresh: bool,
) {
    let rows = R * lanes::<T, S>();
    let zero = T::broadcast(simd, T::default());
    let mut sums = [[zero; R]; N];
    for k in 0..depth {
        let a = T::packs::<S>(&of.A[k * of.stride_A + row..][..rows]);
        let b = &of.B[k * of.stride_B..][..N];
        for n in 0..N {
            let b = if SIGNED { b[n] * of.signs[k] } else { b[n] };
            let b = T::broadcast(simd, b);
            for r in 0..R {
                sums[n][r] = T::multiply_add(simd, a[r], b, sums[n][r]);
            }
        }
    }
    for (n, sums) in sums.iter().enumerate() {
        let c = T::packs_mut::<S>(&mut C[n * stride..][..rows]);
        for r in 0..R {
            c[r] = T::subtract(simd, if fresh { zero } else { c[r] }, sums[r]);
        }
    }
}

/// Number of scalars in a register.
#[inline(always)]
pub fn lanes<T: Packed, S: Simd>() -> usize {
    size_of::<T::Pack<S>>() / size_of::<T>()
}
