//! The backward sweep.

use std::ops::Range;

use super::super::super::coarse::{Coarse, Row};
use super::super::Pair;
use super::super::scaled::Scaled;
use super::registers::{Kernel, Registers};
use super::{rows, transposed_times};

/// The next direction, p = r + (1 + L̃ᵀ) c + β p and t = (1 + L̃ᵀ)⁻¹ p, where c is the coarse correction, in some rows.
pub(super) struct Backward<'a> {
    pub matrix: &'a Scaled,
    pub coarse: &'a Coarse,
    pub beta: f32,
    pub r: &'a [Row],
    pub rows: Range<usize>,
    /// The first row of the vectors below.
    pub first: usize,
    pub p: &'a mut [Row],
    /// The pairs (s, t), of which t is written.
    pub st: &'a mut [Pair],
    /// Sums for the rows that the sweep has not reached, zero before and after.
    pub sums: &'a mut [Pair],
}

impl Kernel for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Registers>(self, registers: R) {
        let Self { matrix: Scaled { pattern, L, G, .. }, coarse, beta, r, first, p, st, sums, .. } = self;
        // The last entry of a row of L̃ is meaningless, that of a vector's row is zero.
        let four = |x: Row| registers.four(x);
        let (ones, negative, beta) = (four([1.0, 1.0, 1.0, 0.0]), four([-1.0, -1.0, -1.0, 0.0]), registers.splat(beta));
        for row in self.rows.rev() {
            let point = &coarse.grid.nodes[row];
            let mut e = registers.splat(0.0);
            for (&corner, weight) in coarse.grid.cells[point.cell as usize].iter().zip(point.weights()) {
                let correction = four(coarse.correction[corner as usize]);
                e = registers.multiply_add(correction, registers.splat(weight), e);
            }
            let own = row - first;
            // Zero again for the next sweep.
            let sum = std::mem::take(&mut sums[own]);
            let c = transposed_times(&G[row], &registers.numbers(e));
            let ([of_w, of_c], r_row, c_row) = (sum.map(four), four(r[row]), four(c));
            let w = registers.multiply_add(of_w, negative, r_row);
            let r_and_c = registers.multiply_add(c_row, ones, r_row);
            let p_row = registers.multiply_add(of_c, ones, registers.multiply_add(four(p[own]), beta, r_and_c));
            p[own] = registers.numbers(p_row);
            let t = registers.multiply_add(four(st[own][1]), beta, registers.multiply_add(c_row, ones, w));
            st[own][1] = registers.numbers(t);
            let w = registers.numbers(w);
            let both = [0, 1, 2].map(|k| registers.pair([[w[k]; 4], [c[k]; 4]]));
            // From the last block to the first, so that memory is read in one direction.
            for block in pattern.row(row).rev() {
                let above = &mut sums[pattern.columns[block] as usize - first];
                let mut sum = registers.pair(*above);
                for (L, both) in rows(L, block).into_iter().zip(both) {
                    sum = registers.multiply_add_pair(registers.pair([L, L]), both, sum);
                }
                *above = registers.numbers_of_pair(sum);
            }
        }
    }
}
