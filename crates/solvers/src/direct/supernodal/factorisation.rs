//! The numeric factorisation, front by front.

use pulp::{Simd, WithSimd};

use super::dense::{Pivots, factor_columns};
use super::fronts::{Front, factor_front};
use super::symbolic::{Supernode, SymbolicFactor};
use super::tasks::Task;
use super::updates::{Update, add_columns, child_updates};
use fem_elements::Real;
use fem_elements::sparse::Block;
use fem_elements::threads::join;
use fem_model::simulation::Breakdown;

/// The numeric factorisation of a task's supernodes, with its parts of the factor and of the workspace. A symmetric matrix has one side, the
/// columns of L; others have two, the columns of L and those of Uᵀ.
pub struct Factorisation<'a, T, const D: usize, const SIDES: usize, const SIGNED: bool> {
    pub symbolic: &'a SymbolicFactor,
    pub task: &'a Task,
    /// The lower half of the matrix, and the upper half, transposed.
    pub values: [&'a [Block<T, D>]; SIDES],
    pub columns: [&'a mut [T]; SIDES],
    /// 1 / diagonal of L, or of U if there are two sides, in postorder.
    pub inverse: &'a mut [T],
    /// The diagonal of S, in postorder; empty unless `SIGNED`.
    pub signs: &'a mut [T],
    /// The row of its supernode with which each row is exchanged, one after the other; empty unless there are two sides.
    pub swaps: &'a mut [u32],
    /// Update matrices that have not been assembled into a parent yet.
    pub updates: [&'a mut [T]; SIDES],
}

impl<T: Real, const D: usize, const SIDES: usize, const SIGNED: bool> WithSimd
    for Factorisation<'_, T, D, SIDES, SIGNED>
{
    type Output = Result<(), Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Result<(), Breakdown> {
        let Self { symbolic, task, .. } = self;
        self.borrowed().side_by_side(simd, &task.parts)?;
        let mut top = self.gather();
        let Some(first) = symbolic.supernodes.get(task.supernodes.start) else { return Ok(()) };
        let (first_column, first_row) = (first.columns.start, first.diagonal.start);
        for number in task.rest() {
            let supernode = &symbolic.supernodes[number];
            let place = supernode.columns.start - first_column;
            let rows = supernode.diagonal.start - first_row..supernode.diagonal.end - first_row;
            let inverse = &mut self.inverse[rows.clone()];
            let children = symbolic.children(number);
            let base = top - symbolic.len_updates_of(children);
            for side in 0..SIDES {
                let columns = &mut self.columns[side][place..][..supernode.columns.len()];
                copy_matrix(symbolic, supernode, self.values[side], columns, inverse);
                for (child, update) in child_updates(symbolic, children, &self.updates[side][base..]) {
                    add_columns::<T, D>(symbolic, child, update, 0..inverse.len(), columns, supernode.stride);
                }
            }
            let mut columns = self.columns.each_mut().map(|columns| &mut columns[place..][..supernode.columns.len()]);
            let signs = if SIGNED { &mut self.signs[rows.clone()] } else { &mut [][..] };
            if const { SIDES == 1 } {
                let mut pivots = Pivots { inverse, signs };
                factor_columns::<T, S, SIGNED>(simd, columns[0], supernode.stride, &mut pivots)?;
            } else {
                let (before, after) = columns.split_at_mut(1);
                let (L, U, swaps) = (&mut *before[0], &mut *after[0], &mut self.swaps[rows.clone()]);
                factor_front(simd, &mut Front { L, U, stride: supernode.stride, inverse, swaps })?;
            }
            for side in 0..SIDES {
                let (of_children, own) = self.updates[side][base..].split_at_mut(top - base);
                let (A, B) = (&*columns[side], &*columns[SIDES - 1 - side]);
                let update = Update::<T, D, SIGNED> { symbolic, supernode, children, of_children, A, B, signs };
                update.compute(simd, &mut own[..supernode.len_update()]);
                self.updates[side].copy_within(top..top + supernode.len_update(), base);
            }
            top = base + supernode.len_update();
        }
        Ok(())
    }
}

impl<'a, T: Real, const D: usize, const SIDES: usize, const SIGNED: bool> Factorisation<'a, T, D, SIDES, SIGNED> {
    /// The same, for its tasks: they take parts of it, and it goes on after them.
    fn borrowed(&mut self) -> Factorisation<'_, T, D, SIDES, SIGNED> {
        let Self { symbolic, task, values, .. } = *self;
        Factorisation {
            symbolic,
            task,
            values,
            columns: self.columns.each_mut().map(|columns| &mut **columns),
            inverse: self.inverse,
            signs: self.signs,
            swaps: self.swaps,
            updates: self.updates.each_mut().map(|updates| &mut **updates),
        }
    }

    /// Factorises these tasks, which are the first of its own, side by side.
    fn side_by_side<S: Simd>(mut self, simd: S, tasks: &'a [Task]) -> Result<(), Breakdown> {
        let [task, rest @ ..] = tasks else { return Ok(()) };
        let (columns, rows) = (task.columns(self.symbolic), task.diagonal(self.symbolic));
        let first = Self {
            task,
            columns: self.columns.each_mut().map(|all| take(all, columns)),
            inverse: take(&mut self.inverse, rows),
            signs: take(&mut self.signs, if SIGNED { rows } else { 0 }),
            swaps: take(&mut self.swaps, if SIDES == 1 { 0 } else { rows }),
            updates: self.updates.each_mut().map(|all| take(all, task.len_updates)),
            ..self
        };
        if rest.is_empty() {
            return simd.vectorize(first);
        }
        let (first, rest) = join(|| simd.vectorize(first), || self.side_by_side(simd, rest));
        first.and(rest)
    }

    /// Moves the update matrices of the finished tasks to the beginning, one after the other. Returns the scalars of a side.
    fn gather(&mut self) -> usize {
        let (mut from, mut to) = (0, 0);
        for part in &self.task.parts {
            let len = part.len_update(self.symbolic);
            self.updates.iter_mut().for_each(|updates| updates.copy_within(from..from + len, to));
            from += part.len_updates;
            to += len;
        }
        to
    }
}

/// Takes the first scalars out of a slice.
fn take<'a, T>(slice: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    slice.split_off_mut(..count).unwrap_or_default()
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
