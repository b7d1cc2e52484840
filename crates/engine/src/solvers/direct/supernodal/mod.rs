//! Sparse Cholesky factorisation A = L Lᵀ by the multifrontal method with supernodes, in one thread: Duff and Reid, The
//! Multifrontal Solution of Indefinite Sparse Symmetric Linear Equations (1983).

mod dense;
mod substitute;
mod symbolic;

use pulp::{Simd, WithSimd};

use dense::{Products, factor_columns};
use substitute::Substitute;
use symbolic::{RowRange, Supernode, SymbolicFactor};

use crate::solvers::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::number::vectorized;
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// The factor with its workspace.
pub(crate) struct SupernodalCholesky<T> {
    symbolic: SymbolicFactor,
    L: Vec<T>,
    /// 1 / diagonal of L, in the order of the rows.
    inverse: Vec<T>,
    /// The stack of update matrices that have not been assembled into a parent yet.
    updates: Vec<T>,
    /// One entry for each row of the largest front.
    front: Vec<T>,
}

impl<T: Real> SupernodalCholesky<T> {
    /// Symbolic factorisation in the order of the rows; `pattern` stores the lower half.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let symbolic = SymbolicFactor::new(pattern, <T as fem_elements::number::Float>::MAX_WIDTH);
        let zeros = |count: usize| vec![T::default(); count];
        let largest = symbolic.supernodes.iter().map(|supernode| supernode.stride).max().unwrap_or(0);
        Self {
            L: zeros(symbolic.len_L),
            inverse: zeros(3 * pattern.rows()),
            updates: zeros(symbolic.len_updates),
            front: zeros(largest),
            symbolic,
        }
    }
}

impl<T: Real> Memoryless for SupernodalCholesky<T> {}

impl<T: Real> ApproximateInverse<T> for SupernodalCholesky<T> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        vectorized(NumericFactorisation { factor: self, values })
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
        vectorized(Substitute {
            symbolic: &self.symbolic,
            L: &self.L,
            inverse: &self.inverse,
            z: z.as_flattened_mut(),
            front: &mut self.front,
        });
    }

    fn bytes(&self) -> usize {
        let scalars = self.L.len() + self.inverse.len() + self.updates.len() + self.front.len();
        scalars * size_of::<T>() + self.symbolic.bytes()
    }
}

struct NumericFactorisation<'a, T> {
    factor: &'a mut SupernodalCholesky<T>,
    values: &'a [[[T; 3]; 3]],
}

impl<T: Real> WithSimd for NumericFactorisation<'_, T> {
    type Output = Result<(), Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Result<(), Breakdown> {
        let Self { factor: SupernodalCholesky { symbolic, L, inverse, updates, .. }, values } = self;
        let mut top = 0;
        for (number, supernode) in symbolic.supernodes.iter().enumerate() {
            let columns = &mut L[supernode.columns.clone()];
            let inverse = &mut inverse[3 * supernode.nodes.start..3 * supernode.nodes.end];
            copy_matrix(symbolic, supernode, values, columns, inverse);
            let children = symbolic.children(number);
            let mut base = top;
            for child in children.clone() {
                base -= symbolic.supernodes[child].len_update();
            }
            let (below, own) = updates[base..].split_at_mut(top - base);
            for (child, update) in child_updates(symbolic, children.clone(), below) {
                assemble_columns(symbolic, child, update, supernode, columns);
            }
            factor_columns(simd, columns, supernode.stride, inverse)?;
            let own = &mut own[..supernode.len_update()];
            compute_update(simd, supernode, columns, own);
            for (child, update) in child_updates(symbolic, children, below) {
                assemble_update(symbolic, child, update, supernode, own);
            }
            updates.copy_within(top..top + supernode.len_update(), base);
            top = base + supernode.len_update();
        }
        Ok(())
    }
}

/// Sets the columns of a supernode to those of the matrix, and `inverse` to the diagonal of the matrix.
#[inline(always)]
fn copy_matrix<T: Real>(
    symbolic: &SymbolicFactor,
    supernode: &Supernode,
    values: &[Block<T, 3>],
    columns: &mut [T],
    inverse: &mut [T],
) {
    columns.fill(T::default());
    for &(block, place) in &symbolic.blocks[supernode.blocks.clone()] {
        let (block, place) = (&values[block as usize], place - supernode.columns.start);
        for c in 0..3 {
            let column = &mut columns[place + c * supernode.stride..][..3];
            for r in 0..3 {
                column[r] = block[r][c];
            }
        }
    }
    for (j, entry) in inverse.iter_mut().enumerate() {
        *entry = columns[j * supernode.stride + j];
    }
}

/// The children with their update matrices, which are contiguous on the stack.
fn child_updates<'a, T>(
    symbolic: &'a SymbolicFactor,
    children: impl Iterator<Item = usize>,
    mut rest: &'a [T],
) -> impl Iterator<Item = (&'a Supernode, &'a [T])> {
    children.map(move |child| {
        let child = &symbolic.supernodes[child];
        let (update, after) = rest.split_at(child.len_update());
        rest = after;
        (child, update)
    })
}

/// The update matrix of the rows below: −L Lᵀ of the supernode's own columns.
fn compute_update<T: Real, S: Simd>(simd: S, supernode: &Supernode, columns: &[T], update: &mut [T]) {
    let below = &columns[3 * supernode.nodes.len()..];
    simd.vectorize(Products {
        C: update,
        stride_C: supernode.update_stride,
        A: below,
        B: below,
        stride_A: supernode.stride,
        depth: 3 * supernode.nodes.len(),
        rows: supernode.update_stride,
        columns: 3 * supernode.below(),
        diagonal: 0,
        fresh: true,
    });
}

/// Adds to the parent's own columns those columns of a child's update matrix that belong to them (extend-add).
#[inline(always)]
fn assemble_columns<T: Real>(
    symbolic: &SymbolicFactor,
    child: &Supernode,
    update: &[T],
    parent: &Supernode,
    columns: &mut [T],
) {
    let ranges = &symbolic.ranges[child.ranges.clone()];
    let width = parent.nodes.len() as u32;
    for (number, range) in ranges.iter().enumerate().take_while(|(_, range)| range.to < width) {
        add_columns(range, &ranges[number..], (update, child.update_stride), (columns, parent.stride), [0, 0]);
    }
}

/// Adds the other columns of a child's update matrix to the parent's (extend-add).
#[inline(always)]
fn assemble_update<T: Real>(
    symbolic: &SymbolicFactor,
    child: &Supernode,
    update: &[T],
    parent: &Supernode,
    own: &mut [T],
) {
    let ranges = &symbolic.ranges[child.ranges.clone()];
    let width = parent.nodes.len();
    let first = ranges.partition_point(|range| (range.to as usize) < width);
    for (number, range) in ranges.iter().enumerate().skip(first) {
        let to = (&mut *own, parent.update_stride);
        add_columns(range, &ranges[number..], (update, child.update_stride), to, [width, width]);
    }
}

/// Adds the columns of one range. Entries above the diagonal in them are meaningless and not read later.
#[inline(always)]
fn add_columns<T: Real>(
    columns: &RowRange,
    rows: &[RowRange],
    (from, stride_from): (&[T], usize),
    (to, stride_to): (&mut [T], usize),
    [first_row, first_column]: [usize; 2],
) {
    for column in 0..3 * columns.count as usize {
        let from = &from[(3 * columns.from as usize + column) * stride_from..][..stride_from];
        let to = &mut to[(3 * (columns.to as usize - first_column) + column) * stride_to..][..stride_to];
        for rows in rows {
            let count = 3 * rows.count as usize;
            let from = &from[3 * rows.from as usize..][..count];
            let to = &mut to[3 * (rows.to as usize - first_row)..][..count];
            for (to, from) in to.iter_mut().zip(from) {
                *to += *from;
            }
        }
    }
}
