//! The forward sweep.

use std::ops::Range;

use super::super::super::coarse::{CellPoint, Row};
use super::super::scaled::Scaled;
use super::super::shares::{Places, Sums};
use super::super::{CHUNK, Pair};
use super::registers::{Kernel, Registers};
use super::{lower_times, rows, symmetric_times};

/// s = (L̃ + 1)⁻¹ (p + K t), and the change of the coarse residual along the direction, in some rows. Returns p·(t + s).
pub(super) struct Forward<'a> {
    pub matrix: &'a Scaled,
    pub points: &'a [CellPoint],
    pub places: Places<'a>,
    pub rows: Range<usize>,
    /// The first row of the vectors below.
    pub first: usize,
    pub p: &'a [Row],
    pub st: &'a mut [Pair],
    /// The change of the coarse residual.
    pub change: Sums<'a>,
}

impl Kernel for Forward<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<R: Registers>(self, registers: R) -> f64 {
        let Self { matrix: Scaled { pattern, L, K, G, .. }, points, places, first, p, st, mut change, .. } = self;
        let (mut total, mut sum) = (0.0, 0.0);
        for row in self.rows {
            // Each entry of a block has sums of its own, so that no addition waits for another.
            let mut sums = [registers.pair([[0.0; 4]; 2]); 3];
            for block in pattern.row(row) {
                let st = registers.pair(st[pattern.columns[block] as usize - first]);
                for (sum, L) in sums.iter_mut().zip(rows(L, block)) {
                    *sum = registers.multiply_add_pair(registers.pair([L, L]), st, *sum);
                }
            }
            let ([s, t], mut y) = (&mut st[row - first], [0.0; 3]);
            let Kt = symmetric_times(&K[row], t);
            for i in 0..3 {
                let [Ls, Lt] = registers.numbers_of_pair(sums[i]).map(sum_of);
                s[i] = p[row - first][i] + Kt[i] - Ls;
                y[i] = t[i] + p[row - first][i] + Kt[i] + Lt;
                sum += p[row - first][i] * (t[i] + s[i]);
            }
            change.add(&places, row, lower_times(&G[row], &y), points[row].weights());
            if row % CHUNK == 0 {
                total += f64::from(sum);
                sum = 0.0;
            }
        }
        total + f64::from(sum)
    }
}

/// Sum of a row of products. The last one is zero, because the last entry of a vector's row is.
#[inline(always)]
fn sum_of(x: Row) -> f32 {
    (x[0] + x[1]) + (x[2] + x[3])
}
