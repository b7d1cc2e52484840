//! Sparse Cholesky factorisation A = L Lᵀ by dense panels, in one thread: multifrontal, Duff and Reid, The Multifrontal Solution
//! of Indefinite Sparse Symmetric Linear Equations (1983).

mod dense;
mod panels;
mod substitute;

use pulp::{Simd, WithSimd};

use dense::{Products, factor_columns};
use panels::{Panel, Panels, Run};
use substitute::Substitute;

use super::Breakdown;
use crate::number::{Real, vectorized};
use crate::sparse::Pattern;

/// A factor, and what it is computed in.
pub struct Supernodal<T> {
    panels: Panels,
    L: Vec<T>,
    /// 1 / diagonal of L, in the order of the rows.
    inverse: Vec<T>,
    /// Update matrices that no parent has taken yet.
    updates: Vec<T>,
    /// One entry for each row of the largest front.
    front: Vec<T>,
}

impl<T: Real> Supernodal<T> {
    /// Finds the entries of L, for the order that the rows are in; `pattern` holds the lower half.
    pub fn new(pattern: &Pattern) -> Self {
        let panels = Panels::new(pattern, <T as Real>::WIDEST);
        let zeros = |count: usize| vec![T::default(); count];
        let largest = panels.panels.iter().map(|panel| panel.stride).max().unwrap_or(0);
        Self {
            L: zeros(panels.len_L),
            inverse: zeros(3 * pattern.rows()),
            updates: zeros(panels.len_updates),
            front: zeros(largest),
            panels,
        }
    }

    /// Computes L.
    pub fn prepare(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        vectorized(Factor { factor: self, values })
    }

    /// z = A⁻¹ r
    pub fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
        vectorized(Substitute {
            plan: &self.panels,
            L: &self.L,
            inverse: &self.inverse,
            z: z.as_flattened_mut(),
            front: &mut self.front,
        });
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let scalars = self.L.len() + self.inverse.len() + self.updates.len() + self.front.len();
        scalars * size_of::<T>() + self.panels.bytes()
    }
}

/// The factorisation, in the widest registers.
struct Factor<'a, T> {
    factor: &'a mut Supernodal<T>,
    values: &'a [[[T; 3]; 3]],
}

impl<T: Real> WithSimd for Factor<'_, T> {
    type Output = Result<(), Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Result<(), Breakdown> {
        let Self { factor, values } = self;
        let mut top = 0;
        for (number, panel) in factor.panels.panels.iter().enumerate() {
            let plan = &factor.panels;
            let columns = &mut factor.L[panel.columns.clone()];
            let inverse = &mut factor.inverse[3 * panel.nodes.start..3 * panel.nodes.end];
            fill(plan, panel, values, columns, inverse);
            let children = plan.children(number);
            let mut base = top;
            for child in children.clone() {
                base -= plan.panels[child].len_update();
            }
            let (theirs, own) = factor.updates[base..].split_at_mut(top - base);
            for (child, update) in updates(plan, children.clone(), theirs) {
                take_columns(plan, child, update, panel, columns);
            }
            factor_columns(simd, columns, panel.stride, inverse)?;
            let own = &mut own[..panel.len_update()];
            subtract_update(simd, panel, columns, own);
            for (child, update) in updates(plan, children, theirs) {
                take_update(plan, child, update, panel, own);
            }
            factor.updates.copy_within(top..top + panel.len_update(), base);
            top = base + panel.len_update();
        }
        Ok(())
    }
}

/// Sets a panel's columns to those of the matrix, and `inverse` to its diagonal.
#[inline(always)]
fn fill<T: Real>(plan: &Panels, panel: &Panel, values: &[[[T; 3]; 3]], columns: &mut [T], inverse: &mut [T]) {
    columns.fill(T::default());
    for &(block, place) in &plan.blocks[panel.blocks.clone()] {
        let (block, place) = (&values[block as usize], place - panel.columns.start);
        for c in 0..3 {
            let column = &mut columns[place + c * panel.stride..][..3];
            for r in 0..3 {
                column[r] = block[r][c];
            }
        }
    }
    for (j, entry) in inverse.iter_mut().enumerate() {
        *entry = columns[j * panel.stride + j];
    }
}

/// The children with their update matrices, which lie one after the other.
fn updates<'a, T>(
    plan: &'a Panels,
    children: impl Iterator<Item = usize>,
    mut rest: &'a [T],
) -> impl Iterator<Item = (&'a Panel, &'a [T])> {
    children.map(move |child| {
        let child = &plan.panels[child];
        let (update, after) = rest.split_at(child.len_update());
        rest = after;
        (child, update)
    })
}

/// Update matrix of the rows below: −L Lᵀ of the panel's own columns.
fn subtract_update<T: Real, S: Simd>(simd: S, panel: &Panel, columns: &[T], update: &mut [T]) {
    let below = &columns[3 * panel.nodes.len()..];
    simd.vectorize(Products {
        C: update,
        stride_C: panel.update_stride,
        A: below,
        B: below,
        stride_A: panel.stride,
        depth: 3 * panel.nodes.len(),
        rows: panel.update_stride,
        columns: 3 * panel.below(),
        diagonal: 0,
        fresh: true,
    });
}

/// Adds those columns of a child's update matrix that stand among the parent's own.
#[inline(always)]
fn take_columns<T: Real>(plan: &Panels, child: &Panel, update: &[T], panel: &Panel, columns: &mut [T]) {
    let runs = &plan.runs[child.runs.clone()];
    let width = panel.nodes.len() as u32;
    for (number, run) in runs.iter().enumerate().take_while(|(_, run)| run.to < width) {
        add_columns(run, &runs[number..], (update, child.update_stride), (columns, panel.stride), [0, 0]);
    }
}

/// Adds the other columns, to the parent's update matrix.
#[inline(always)]
fn take_update<T: Real>(plan: &Panels, child: &Panel, update: &[T], panel: &Panel, own: &mut [T]) {
    let runs = &plan.runs[child.runs.clone()];
    let width = panel.nodes.len();
    let first = runs.partition_point(|run| (run.to as usize) < width);
    for (number, run) in runs.iter().enumerate().skip(first) {
        add_columns(run, &runs[number..], (update, child.update_stride), (own, panel.update_stride), [width, width]);
    }
}

/// Adds the columns of one run. What stands above the diagonal in them has no meaning and does no harm.
#[inline(always)]
fn add_columns<T: Real>(
    run: &Run,
    rows: &[Run],
    (from, stride_from): (&[T], usize),
    (to, stride_to): (&mut [T], usize),
    [first_row, first_column]: [usize; 2],
) {
    for column in 0..3 * run.count as usize {
        let from = &from[(3 * run.from as usize + column) * stride_from..][..stride_from];
        let to = &mut to[(3 * (run.to as usize - first_column) + column) * stride_to..][..stride_to];
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
