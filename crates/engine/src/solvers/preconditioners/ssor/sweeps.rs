//! The two sweeps of an iteration. Each reads a block once and applies it to two vectors together.

use std::array::from_fn;

use pulp::{Simd, WithSimd};
use simba::simd::WideF32x8;

use super::coarse::Coarse;
use super::scaled::{Scaled, Triangle};
use super::{CHUNK, Pair, Row};

/// The next direction, p = r + (1 + L̃ᵀ) c + β p and t = (1 + L̃ᵀ)⁻¹ p, where c is the coarse correction.
pub struct Backward<'a> {
    pub matrix: &'a Scaled,
    pub coarse: &'a Coarse,
    pub beta: f32,
    pub r: &'a [Row],
    pub p: &'a mut [Row],
    /// The pairs (s, t), of which t is written.
    pub st: &'a mut [Pair],
    /// Sums for the rows that the sweep has not reached, zero before and after.
    pub sums: &'a mut [Pair],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { matrix: Scaled { pattern, L, G, .. }, coarse, beta, r, p, st, sums } = self;
        for row in (0..r.len()).rev() {
            let point = &coarse.grid.nodes[row];
            let mut e = [0.0; 4];
            for (&corner, weight) in coarse.grid.cells[point.cell as usize].iter().zip(point.weights()) {
                e = plus_products(e, coarse.correction[corner as usize], [weight; 4]);
            }
            // Zero again for the next sweep.
            let sum = std::mem::take(&mut sums[row]);
            let c = transposed_times(&G[row], &e);
            let w: Row = from_fn(|k| if k < 3 { r[row][k] - sum[0][k] } else { 0.0 });
            for k in 0..3 {
                p[row][k] = r[row][k] + (c[k] + sum[1][k]) + beta * p[row][k];
                st[row][1][k] = w[k] + c[k] + beta * st[row][1][k];
            }
            let blocks = pattern.row(row);
            // From the last block to the first, so that memory is read in one direction.
            for block in blocks.rev() {
                let (L, above) = (rows(L, block), &mut sums[pattern.columns[block] as usize]);
                let [of_w, of_c] = *above;
                *above = [plus_product(of_w, &L, &w), plus_product(of_c, &L, &c)];
            }
        }
    }
}

/// Gᵀ x for a lower triangular G.
#[inline(always)]
fn transposed_times(G: &Triangle, x: &Row) -> Row {
    [G[0] * x[0] + G[1] * x[1] + G[3] * x[2], G[2] * x[1] + G[4] * x[2], G[5] * x[2], 0.0]
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

/// The rows of a block, each followed by a meaningless number.
#[inline(always)]
fn rows(L: &[f32], block: usize) -> [Row; 3] {
    let L = &L[9 * block..9 * block + 10];
    [[L[0], L[1], L[2], L[3]], [L[3], L[4], L[5], L[6]], [L[6], L[7], L[8], L[9]]]
}

/// sum + Lᵀ x. The sum is passed by value, so that the compiler knows that it has no alias.
#[inline(always)]
fn plus_product(sum: Row, L: &[Row; 3], x: &Row) -> Row {
    from_fn(|k| sum[k] + (L[0][k] * x[0] + L[1][k] * x[1] + L[2][k] * x[2]))
}

/// Two rows in one register.
#[inline(always)]
fn wide(a: Row, b: Row) -> WideF32x8 {
    WideF32x8::from([a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]])
}

/// sum + a b by entries.
#[inline(always)]
fn plus_products(sum: Row, a: Row, b: Row) -> Row {
    from_fn(|k| sum[k] + a[k] * b[k])
}

/// s = (L̃ + 1)⁻¹ (p + K t), and the change of the coarse residual along the direction. Returns p·(t + s).
pub struct Forward<'a> {
    pub matrix: &'a Scaled,
    pub coarse: &'a mut Coarse,
    pub p: &'a [Row],
    pub st: &'a mut [Pair],
}

impl WithSimd for Forward<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let Self { matrix: Scaled { pattern, L, K, G, .. }, coarse, p, st } = self;
        let (mut total, mut sum) = (0.0, 0.0);
        coarse.change.fill([0.0; 4]);
        for row in 0..p.len() {
            // Each entry of a block has sums of its own, so that no addition waits for another.
            let mut sums = [wide([0.0; 4], [0.0; 4]); 3];
            let blocks = pattern.row(row);
            for block in blocks {
                let (L, [s, t]) = (rows(L, block), st[pattern.columns[block] as usize]);
                for (sums, L) in sums.iter_mut().zip(L) {
                    *sums += wide(L, L) * wide(s, t);
                }
            }
            let ([s, t], mut y) = (&mut st[row], [0.0; 3]);
            let Kt = symmetric_times(&K[row], t);
            for i in 0..3 {
                let sums: [f32; 8] = sums[i].0.to_array();
                let (Ls, Lt) = (sums[0] + sums[1] + sums[2], sums[4] + sums[5] + sums[6]);
                s[i] = p[row][i] + Kt[i] - Ls;
                y[i] = t[i] + p[row][i] + Kt[i] + Lt;
                sum += p[row][i] * (t[i] + s[i]);
            }
            let change = lower_times(&G[row], &y);
            let point = &coarse.grid.nodes[row];
            for (&corner, weight) in coarse.grid.cells[point.cell as usize].iter().zip(point.weights()) {
                let of_corner = &mut coarse.change[corner as usize];
                *of_corner = plus_products(*of_corner, change, [weight; 4]);
            }
            if row % CHUNK == 0 {
                total += f64::from(sum);
                sum = 0.0;
            }
        }
        total + f64::from(sum)
    }
}
