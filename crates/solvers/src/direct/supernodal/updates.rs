//! Update matrices: what the columns of a supernode, and the update matrices of its children, contribute to columns after them.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::products::Products;
use super::symbolic::{RowRange, Supernode, SymbolicFactor};
use fem_elements::Real;
use fem_elements::threads::join;

/// An update matrix −A S Bᵀ, with those of the children added (extend-add).
pub struct Update<'a, T, const D: usize, const SIGNED: bool> {
    pub symbolic: &'a SymbolicFactor,
    pub supernode: &'a Supernode,
    /// The children, and their update matrices one after the other.
    pub children: &'a [usize],
    pub of_children: &'a [T],
    /// Columns of the supernode.
    pub A: &'a [T],
    pub B: &'a [T],
    /// The diagonal of S; empty for S = 1.
    pub signs: &'a [T],
}

impl<T: Real, const D: usize, const SIGNED: bool> Update<'_, T, D, SIGNED> {
    /// Computes it. Threads share its blocks of columns, so that no entry depends on their number.
    pub fn compute<S: Simd>(&self, simd: S, own: &mut [T]) {
        if self.supernode.below > 0 {
            self.blocks(simd, 0..self.supernode.update_blocks(), own);
        }
    }

    fn blocks<S: Simd>(&self, simd: S, Range { start, end }: Range<usize>, own: &mut [T]) {
        let middle = start.midpoint(end);
        if middle == start {
            return simd.vectorize(UpdateBlock { of: self, block: start, own });
        }
        let scalars = self.supernode.start_of_update(middle) - self.supernode.start_of_update(start);
        let (left, right) = own.split_at_mut(scalars);
        join(|| self.blocks(simd, start..middle, left), || self.blocks(simd, middle..end, right));
    }
}

/// A block of columns of an update matrix.
struct UpdateBlock<'a, T, const D: usize, const SIGNED: bool> {
    of: &'a Update<'a, T, D, SIGNED>,
    block: usize,
    own: &'a mut [T],
}

impl<T: Real, const D: usize, const SIGNED: bool> WithSimd for UpdateBlock<'_, T, D, SIGNED> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { of, block, own } = self;
        let &Update { symbolic, supernode, children, of_children, A, B, signs } = of;
        let columns = supernode.update_columns(block);
        let (depth, rows) = (supernode.diagonal.len(), supernode.update_rows - columns.start);
        let products = Products::<T, SIGNED> {
            C: &mut *own,
            stride_C: rows,
            A: &A[depth + columns.start..],
            B: &B[depth + columns.start..],
            stride_A: supernode.stride,
            stride_B: supernode.stride,
            depth,
            signs,
            rows,
            columns: columns.len(),
            diagonal: 0,
            fresh: true,
        };
        products.compute(simd);
        // The block in rows and columns of the front.
        let first = depth + columns.start;
        for (child, update) in child_updates(symbolic, children, of_children) {
            add_columns::<T, D>(symbolic, child, update, first..first + columns.len(), own, rows);
        }
    }
}

/// The children with their update matrices, which are contiguous on the stack.
pub fn child_updates<'a, T>(
    symbolic: &'a SymbolicFactor,
    children: &'a [usize],
    mut rest: &'a [T],
) -> impl Iterator<Item = (&'a Supernode, &'a [T])> {
    children.iter().map(move |&child| {
        let child = &symbolic.supernodes[child];
        let (update, after) = rest.split_at(child.len_update());
        rest = after;
        (child, update)
    })
}

/// Adds to the columns `to` of a front those columns of a child's update matrix that belong to them. `to` has rows from the first of these columns
/// on, `stride` from one column to the next. Entries above the diagonal are meaningless and not read later.
#[inline(always)]
pub fn add_columns<T: Real, const D: usize>(
    symbolic: &SymbolicFactor,
    child: &Supernode,
    update: &[T],
    columns: Range<usize>,
    to: &mut [T],
    stride: usize,
) {
    let ranges = &symbolic.ranges[child.ranges.clone()];
    let skipped = ranges.partition_point(|range| D * (range.to + range.count) as usize <= columns.start);
    let belong = |(_, range): &(usize, &RowRange)| D * (range.to as usize) < columns.end;
    for (number, range) in ranges.iter().enumerate().skip(skipped).take_while(belong) {
        let RowRange { from, to: first, count } = range.scalars::<D>();
        for column in columns.start.saturating_sub(first)..count.min(columns.end - first) {
            let from_column = &update[child.update_column(from + column)..];
            let to_column = &mut to[(first + column - columns.start) * stride..][..stride];
            add(&from_column[from + column..], &mut to_column[first + column - columns.start..], count - column);
            for rows in &ranges[number + 1..] {
                let RowRange { from, to, count } = rows.scalars::<D>();
                add(&from_column[from..], &mut to_column[to - columns.start..], count);
            }
        }
    }
}

#[inline(always)]
fn add<T: Real>(from: &[T], to: &mut [T], count: usize) {
    for (to, from) in to[..count].iter_mut().zip(&from[..count]) {
        *to += *from;
    }
}
