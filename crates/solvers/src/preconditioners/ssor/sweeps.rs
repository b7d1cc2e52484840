//! The two sweeps of an iteration. Each reads a block once and applies it to two vectors together.

mod backward;
mod forward;
mod registers;
mod start;

pub use start::Start;

use backward::Backward;
use forward::Forward;
use registers::dispatch;

use super::super::coarse::{Coarse, Row};
use super::Pair;
use super::scaled::{Scaled, Triangle};
use super::shares::{Places, Sums};
use crate::parts::Part;
use fem_elements::threads::join;

/// The next direction, p = r + (1 + L̃ᵀ) c + β p with the coarse correction c, t = (1 + L̃ᵀ)⁻¹ p, s = (L̃ + 1)⁻¹ (p + K t), and the
/// change of the coarse residual along the direction.
pub struct Sweeps<'a> {
    pub matrix: &'a Scaled,
    pub coarse: &'a Coarse,
    pub places: Places<'a>,
    pub beta: f32,
    pub r: &'a [Row],
    /// The first row of the vectors below.
    pub first: usize,
    pub p: &'a mut [Row],
    /// The pairs (s, t).
    pub st: &'a mut [Pair],
    /// Workspace of the backward sweep, zero before and after.
    pub sums: &'a mut [Pair],
    pub change: Sums<'a>,
}

impl Sweeps<'_> {
    /// Both sweeps over the rows of a part: backward over its own, then both over its halves, side by side, while their blocks are in
    /// the cache, then forward over its own. Returns p·(t + s).
    pub fn over(mut self, part: &Part) -> f64 {
        let Self { matrix, coarse, places, beta, r, first, .. } = self;
        let (p, st, sums) = (&mut *self.p, &mut *self.st, &mut *self.sums);
        dispatch(Backward { matrix, coarse, beta, r, rows: part.own(), first, p, st, sums });
        let of_halves = match part.halves.as_deref() {
            Some([left, right]) => {
                let [a, b] = self.halves(part);
                let (a, b) = join(|| a.over(left), || b.over(right));
                a + b
            }
            None => 0.0,
        };
        let Self { p, st, change, .. } = &mut self;
        let [_, _, change] = change.split(part, &places);
        let points = &coarse.grid.nodes;
        of_halves + dispatch(Forward { matrix, points, places, rows: part.own(), first, p, st, change })
    }

    /// The halves of a part that has halves.
    fn halves(&mut self, part: &Part) -> [Sweeps<'_>; 2] {
        let Self { matrix, coarse, places, beta, r, first, p, st, sums, change } = self;
        let (matrix, coarse, places, beta, r) = (*matrix, *coarse, *places, *beta, *r);
        let [left, right, _] = change.split(part, &places);
        let middle = part.middle() - *first;
        let (p, p_right) = p.split_at_mut(middle);
        let (st, st_right) = st.split_at_mut(middle);
        let (sums, sums_right) = sums.split_at_mut(middle);
        let sweeps =
            |first, p, st, sums, change| Sweeps { matrix, coarse, places, beta, r, first, p, st, sums, change };
        [sweeps(*first, p, st, sums, left), sweeps(part.middle(), p_right, st_right, sums_right, right)]
    }
}

/// The rows of a block, each followed by a meaningless number.
#[inline(always)]
fn rows(L: &[f32], block: usize) -> [Row; 3] {
    let L = &L[9 * block..9 * block + 10];
    [[L[0], L[1], L[2], L[3]], [L[3], L[4], L[5], L[6]], [L[6], L[7], L[8], L[9]]]
}

/// Gᵀ x for a lower triangular G.
#[inline(always)]
fn transposed_times(G: &Triangle, x: &Row) -> Row {
    [G[0] * x[0] + G[1] * x[1] + G[3] * x[2], G[2] * x[1] + G[4] * x[2], G[5] * x[2], x[3]]
}

/// G x for a lower triangular G.
#[inline(always)]
fn lower_times(G: &Triangle, x: &[f32; 3]) -> Row {
    [G[0] * x[0], G[1] * x[0] + G[2] * x[1], G[3] * x[0] + G[4] * x[1] + G[5] * x[2], 0.0]
}

/// K x for a symmetric K.
#[inline(always)]
fn symmetric_times(K: &Triangle, x: &Row) -> [f32; 3] {
    [
        K[0] * x[0] + K[1] * x[1] + K[3] * x[2],
        K[1] * x[0] + K[2] * x[1] + K[4] * x[2],
        K[3] * x[0] + K[4] * x[1] + K[5] * x[2],
    ]
}
