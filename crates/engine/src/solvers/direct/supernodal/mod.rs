//! Sparse factorisation A = L S Lᵀ by the multifrontal method with supernodes, in parallel over subtrees and within large fronts: Duff and Reid,
//! The Multifrontal Solution of Indefinite Sparse Symmetric Linear Equations (1983); Amestoy and Duff, Vectorization of a Multiprocessor
//! Multifrontal Code (1989). S = 1 if A is positive definite, as in Cholesky's method; else its entries are 1 or −1, without pivoting. And the
//! factorisation A = P L U of matrices that are not symmetric, or need pivots.

mod dense;
mod fronts;
mod lu;
mod products;
mod substitute;
mod symbolic;
mod tasks;

use pulp::{Simd, WithSimd};

pub(crate) use lu::Lu;

use dense::{Pivots, factor_columns};
use products::Products;
use substitute::Substitute;
use symbolic::{RowRange, Supernode, SymbolicFactor};
use tasks::Task;

use crate::solvers::memory::available_memory;
use crate::solvers::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::number::{Float, vectorized};
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// The Cholesky factor of a matrix with three rows for each node.
pub(crate) type SupernodalCholesky<T> = Supernodal<T, 3, false>;

/// The factor of a matrix of D×D blocks, with its workspace. `SIGNED`: the matrix may be indefinite.
pub(crate) struct Supernodal<T, const D: usize, const SIGNED: bool> {
    symbolic: SymbolicFactor,
    task: Task,
    /// False if the factor does not fit into memory.
    fits: bool,
    L: Vec<T>,
    /// 1 / diagonal of L, in postorder.
    inverse: Vec<T>,
    /// The diagonal of S, in postorder; empty unless `SIGNED`.
    signs: Vec<T>,
    /// Update matrices that have not been assembled into a parent yet.
    updates: Vec<T>,
    /// One entry for each row of the largest front.
    front: Vec<T>,
}

impl<T: Real, const D: usize, const SIGNED: bool> Supernodal<T, D, SIGNED> {
    /// Symbolic factorisation in the order of the rows; `pattern` stores the lower half. Where the factor and its workspace would not fit into
    /// memory, every factorisation returns [`Breakdown::TooLarge`].
    pub(crate) fn new(pattern: &Pattern) -> Self {
        Self::within(pattern, available_memory())
    }

    /// The same with a limit of so many bytes.
    pub(crate) fn within(pattern: &Pattern, limit: Option<usize>) -> Self {
        let symbolic = SymbolicFactor::new(pattern, D, <T as Float>::MAX_WIDTH);
        let task = Task::new(&symbolic);
        let rows = D * pattern.rows();
        let largest = symbolic.supernodes.iter().map(|supernode| supernode.stride).max().unwrap_or(0);
        let sizes = [symbolic.len_L, rows, if SIGNED { rows } else { 0 }, task.len_updates, largest];
        let memory = zeros(sizes, limit);
        let fits = memory.is_some();
        let [L, inverse, signs, updates, front] = memory.unwrap_or_default();
        Self { symbolic, task, fits, L, inverse, signs, updates, front }
    }

    /// Factors the matrix with these values.
    pub(crate) fn factor(&mut self, values: &[Block<T, D>]) -> Result<(), Breakdown> {
        let Self { symbolic, task, L, inverse, signs, updates, .. } = self;
        if !self.fits {
            return Err(Breakdown::TooLarge);
        }
        vectorized(Factorisation::<T, D, SIGNED> { symbolic, task, values, L, inverse, signs, updates })
    }

    /// z = A⁻¹ z, where there is a factor.
    pub(crate) fn solve(&mut self, z: &mut [T]) {
        let Self { symbolic, L, inverse, signs, front, .. } = self;
        if self.fits {
            let columns = (&L[..], &inverse[..]);
            vectorized(Substitute::<T, D> {
                symbolic,
                forward: columns,
                backward: columns,
                signs,
                swaps: &[],
                z,
                front,
            });
        }
    }

    /// The diagonal of S, in another order than the rows; empty unless `SIGNED`.
    pub(crate) fn signs(&self) -> &[T] {
        &self.signs
    }

    pub(crate) fn bytes(&self) -> usize {
        let scalars = [&self.L, &self.inverse, &self.signs, &self.updates, &self.front].map(Vec::len);
        scalars.into_iter().sum::<usize>() * size_of::<T>() + self.symbolic.bytes()
    }
}

/// Zeros of these sizes; `None` if there is no memory for them, or they would take more than so many bytes.
fn zeros<T: Real, const N: usize>(sizes: [usize; N], limit: Option<usize>) -> Option<[Vec<T>; N]> {
    if limit.is_some_and(|limit| sizes.iter().sum::<usize>() > limit / size_of::<T>()) {
        return None;
    }
    let mut zeros = [const { Vec::new() }; N];
    for (zeros, size) in zeros.iter_mut().zip(sizes) {
        zeros.try_reserve_exact(size).ok()?;
        zeros.resize(size, T::default());
    }
    Some(zeros)
}

impl<T: Real> Memoryless for SupernodalCholesky<T> {}

impl<T: Real> ApproximateInverse<T> for SupernodalCholesky<T> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.factor(values)
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
        self.solve(z.as_flattened_mut());
    }

    fn bytes(&self) -> usize {
        self.bytes()
    }
}

/// The numeric factorisation of a task's supernodes, with its parts of the factor and of the workspace.
struct Factorisation<'a, T, const D: usize, const SIGNED: bool> {
    symbolic: &'a SymbolicFactor,
    task: &'a Task,
    values: &'a [Block<T, D>],
    L: &'a mut [T],
    inverse: &'a mut [T],
    signs: &'a mut [T],
    updates: &'a mut [T],
}

impl<T: Real, const D: usize, const SIGNED: bool> WithSimd for Factorisation<'_, T, D, SIGNED> {
    type Output = Result<(), Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Result<(), Breakdown> {
        let Self { symbolic, task, values, L, inverse, signs, updates } = self;
        let parts = Parts { of: &task.parts, L, inverse, signs, updates };
        parts.factor::<S, D, SIGNED>(simd, symbolic, values)?;
        let mut top = gather(symbolic, &task.parts, updates);
        let Some(first) = symbolic.supernodes.get(task.supernodes.start) else { return Ok(()) };
        let (first_column, first_row) = (first.columns.start, first.diagonal.start);
        for number in task.rest() {
            let supernode = &symbolic.supernodes[number];
            let columns = &mut L[supernode.columns.start - first_column..][..supernode.columns.len()];
            let rows = supernode.diagonal.start - first_row..supernode.diagonal.end - first_row;
            let signs = if SIGNED { &mut signs[rows.clone()] } else { &mut [][..] };
            let mut pivots = Pivots { inverse: &mut inverse[rows], signs };
            copy_matrix(symbolic, supernode, values, columns, pivots.inverse);
            let children = symbolic.children(number);
            let base = top - symbolic.len_updates_of(children);
            let (below, own) = updates[base..].split_at_mut(top - base);
            for (child, update) in child_updates(symbolic, children, below) {
                assemble_columns::<T, D>(symbolic, child, update, supernode, columns);
            }
            factor_columns::<T, S, SIGNED>(simd, columns, supernode.stride, &mut pivots)?;
            let own = &mut own[..supernode.len_update()];
            compute_update::<T, S, SIGNED>(simd, supernode, [columns, columns], pivots.signs, own);
            for (child, update) in child_updates(symbolic, children, below) {
                assemble_update::<T, D>(symbolic, child, update, supernode, own);
            }
            updates.copy_within(top..top + supernode.len_update(), base);
            top = base + supernode.len_update();
        }
        Ok(())
    }
}

/// Tasks side by side, with their parts of the factor and of the workspace.
struct Parts<'a, T> {
    of: &'a [Task],
    L: &'a mut [T],
    inverse: &'a mut [T],
    signs: &'a mut [T],
    updates: &'a mut [T],
}

impl<T: Real> Parts<'_, T> {
    fn factor<S: Simd, const D: usize, const SIGNED: bool>(
        self,
        simd: S,
        symbolic: &SymbolicFactor,
        values: &[Block<T, D>],
    ) -> Result<(), Breakdown> {
        let Self { of: [task, rest @ ..], L, inverse, signs, updates } = self else { return Ok(()) };
        let (L, of_rest) = L.split_at_mut(task.columns(symbolic));
        let (inverse, inverse_of_rest) = inverse.split_at_mut(task.diagonal(symbolic));
        let (signs, signs_of_rest) = signs.split_at_mut(if SIGNED { inverse.len() } else { 0 });
        let (updates, updates_of_rest) = updates.split_at_mut(task.len_updates);
        let first = Factorisation::<T, D, SIGNED> { symbolic, task, values, L, inverse, signs, updates };
        let rest =
            Parts { of: rest, L: of_rest, inverse: inverse_of_rest, signs: signs_of_rest, updates: updates_of_rest };
        if rest.of.is_empty() {
            return simd.vectorize(first);
        }
        let (first, rest) =
            rayon::join(|| simd.vectorize(first), || rest.factor::<S, D, SIGNED>(simd, symbolic, values));
        first.and(rest)
    }
}

/// Moves the update matrices of finished tasks to the beginning, one after the other. Returns their scalars.
fn gather<T: Real>(symbolic: &SymbolicFactor, parts: &[Task], updates: &mut [T]) -> usize {
    let (mut from, mut to) = (0, 0);
    for part in parts {
        let len = part.len_update(symbolic);
        updates.copy_within(from..from + len, to);
        from += part.len_updates;
        to += len;
    }
    to
}

/// Sets the columns of a supernode to those of the matrix, and `inverse` to the diagonal of the matrix.
#[inline(always)]
fn copy_matrix<T: Real, const D: usize>(
    symbolic: &SymbolicFactor,
    supernode: &Supernode,
    values: &[Block<T, D>],
    columns: &mut [T],
    inverse: &mut [T],
) {
    columns.fill(T::default());
    for &(block, place) in &symbolic.blocks[supernode.blocks.clone()] {
        let (block, place) = (&values[block as usize], place - supernode.columns.start);
        for c in 0..D {
            let column = &mut columns[place + c * supernode.stride..][..D];
            for r in 0..D {
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

/// The update matrix of the rows below, −A S Bᵀ of columns of a supernode.
fn compute_update<T: Real, S: Simd, const SIGNED: bool>(
    simd: S,
    supernode: &Supernode,
    [A, B]: [&[T]; 2],
    signs: &[T],
    update: &mut [T],
) {
    let depth = supernode.diagonal.len();
    if supernode.below == 0 {
        return;
    }
    let products = Products::<T, SIGNED> {
        C: update,
        stride_C: supernode.update_stride,
        A: &A[depth..],
        B: &B[depth..],
        stride_A: supernode.stride,
        stride_B: supernode.stride,
        depth,
        signs,
        rows: supernode.update_stride,
        columns: supernode.below,
        diagonal: 0,
        fresh: true,
    };
    products.compute(simd);
}

/// Adds to the parent's own columns those columns of a child's update matrix that belong to them (extend-add).
#[inline(always)]
fn assemble_columns<T: Real, const D: usize>(
    symbolic: &SymbolicFactor,
    child: &Supernode,
    update: &[T],
    parent: &Supernode,
    columns: &mut [T],
) {
    let ranges = &symbolic.ranges[child.ranges.clone()];
    let width = parent.nodes.len() as u32;
    for (number, range) in ranges.iter().enumerate().take_while(|(_, range)| range.to < width) {
        add_columns::<T, D>(range, &ranges[number..], (update, child.update_stride), (columns, parent.stride), [0, 0]);
    }
}

/// Adds the other columns of a child's update matrix to the parent's (extend-add).
#[inline(always)]
fn assemble_update<T: Real, const D: usize>(
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
        add_columns::<T, D>(range, &ranges[number..], (update, child.update_stride), to, [width, width]);
    }
}

/// Adds the columns of one range. Entries above the diagonal in them are meaningless and not read later.
#[inline(always)]
fn add_columns<T: Real, const D: usize>(
    columns: &RowRange,
    rows: &[RowRange],
    (from, stride_from): (&[T], usize),
    (to, stride_to): (&mut [T], usize),
    [first_row, first_column]: [usize; 2],
) {
    for column in 0..D * columns.count as usize {
        let from = &from[(D * columns.from as usize + column) * stride_from..][..stride_from];
        let to = &mut to[(D * (columns.to as usize - first_column) + column) * stride_to..][..stride_to];
        for rows in rows {
            let count = D * rows.count as usize;
            let from = &from[D * rows.from as usize..][..count];
            let to = &mut to[D * (rows.to as usize - first_row)..][..count];
            for (to, from) in to.iter_mut().zip(from) {
                *to += *from;
            }
        }
    }
}
