//! The forward sweep that starts an iteration.

use std::ops::Range;

use super::super::super::coarse::{Coarse, Row};
use super::super::scaled::Scaled;
use super::super::shares::{Places, Sums};
use crate::parts::Part;
use fem_elements::Real;
use fem_elements::threads::join;
use fem_elements::vector::triple;

/// r̃ = (L̃ + 1)⁻¹ G⁻¹ b and the coarse residual Pᵀ b, with b scaled by `factor`.
pub struct Start<'a, T> {
    pub matrix: &'a Scaled,
    pub coarse: &'a Coarse,
    pub places: Places<'a>,
    pub b: &'a [[T; 3]],
    pub factor: f64,
    /// The first row of `r`.
    pub first: usize,
    pub r: &'a mut [Row],
    pub residual: Sums<'a>,
}

impl<T: Real> Start<'_, T> {
    /// Sweeps over the rows of a part: its halves side by side, then its own.
    pub fn over(mut self, part: &Part) {
        if let Some([left, right]) = part.halves.as_deref() {
            let Self { matrix, coarse, places, b, factor, first, ref mut r, ref mut residual } = self;
            let [residual_left, residual_right, _] = residual.split(part, &places);
            let (r_left, r_right) = r.split_at_mut(part.middle() - first);
            let start = |first, r, residual| Start { matrix, coarse, places, b, factor, first, r, residual };
            join(
                || start(first, r_left, residual_left).over(left),
                || start(part.middle(), r_right, residual_right).over(right),
            );
        }
        let [_, _, residual] = self.residual.split(part, &self.places);
        let Self { matrix, coarse, places, b, factor, first, r, .. } = self;
        Start { matrix, coarse, places, b, factor, first, r, residual }.rows(part.own());
    }

    fn rows(self, rows: Range<usize>) {
        let Self { matrix: Scaled { pattern, L, inverses, .. }, coarse, places, b, factor, first, r, mut residual } =
            self;
        for row in rows {
            let b = b[row].map(|b| (b.as_f64() * factor) as f32);
            let free = &coarse.free[row];
            let of_free = [free[0] * b[0], free[1] * b[1], free[2] * b[2], 0.0];
            residual.add(&places, row, of_free, coarse.grid.nodes[row].weights());
            let mut scaled: [f32; 3] = triple(|i| (0..=i).map(|j| inverses[row][i][j] * b[j]).sum());
            for block in pattern.row(row) {
                let known = &r[pattern.columns[block] as usize - first];
                (0..3).for_each(|i| scaled[i] -= (0..3).map(|k| L[9 * block + 3 * i + k] * known[k]).sum::<f32>());
            }
            r[row - first] = [scaled[0], scaled[1], scaled[2], 0.0];
        }
    }
}
