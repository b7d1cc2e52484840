//! Forward and backward substitution, panel by panel, a node's three columns at a time.

use pulp::{Simd, WithSimd};

use super::dense::lanes;
use super::panels::{Panel, Panels};
use crate::number::Real;

/// z = L⁻ᵀ L⁻¹ z
pub struct Substitute<'a, T> {
    pub plan: &'a Panels,
    pub L: &'a [T],
    /// 1 / diagonal of L
    pub inverse: &'a [T],
    pub z: &'a mut [T],
    /// As long as the longest column of L.
    pub front: &'a mut [T],
}

impl<T: Real> WithSimd for Substitute<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let plan = self.plan;
        for panel in &plan.panels {
            self.forward(simd, panel, &plan.rows[panel.rows.clone()]);
        }
        for panel in plan.panels.iter().rev() {
            self.backward(simd, panel, &plan.rows[panel.rows.clone()]);
        }
    }
}

impl<T: Real> Substitute<'_, T> {
    /// L⁻¹ for the columns of a panel.
    #[inline(always)]
    fn forward<S: Simd>(&mut self, simd: S, panel: &Panel, rows: &[u32]) {
        let own = 3 * panel.nodes.start..3 * panel.nodes.end;
        let x = &mut self.front[..panel.stride];
        let (head, tail) = x.split_at_mut(own.len());
        head.copy_from_slice(&self.z[own.clone()]);
        tail.fill(T::default());
        forward(simd, &self.L[panel.columns.clone()], &self.inverse[own.clone()], x);
        self.z[own.clone()].copy_from_slice(&x[..own.len()]);
        for (x, &row) in x[own.len()..].as_chunks::<3>().0.iter().zip(rows) {
            let z = &mut self.z[3 * row as usize..][..3];
            for i in 0..3 {
                z[i] += x[i];
            }
        }
    }

    /// L⁻ᵀ for the columns of a panel.
    #[inline(always)]
    fn backward<S: Simd>(&mut self, simd: S, panel: &Panel, rows: &[u32]) {
        let own = 3 * panel.nodes.start..3 * panel.nodes.end;
        let x = &mut self.front[..panel.stride];
        let (head, tail) = x.split_at_mut(own.len());
        head.copy_from_slice(&self.z[own.clone()]);
        tail[3 * rows.len()..].fill(T::default());
        for (x, &row) in tail.as_chunks_mut::<3>().0.iter_mut().zip(rows) {
            x.copy_from_slice(&self.z[3 * row as usize..][..3]);
        }
        backward(simd, &self.L[panel.columns.clone()], &self.inverse[own.clone()], x);
        self.z[own.clone()].copy_from_slice(&x[..own.len()]);
    }
}

/// x = L⁻¹ x for the first entries of x; the others get what those subtract from them.
#[inline(always)]
fn forward<T: Real, S: Simd>(simd: S, L: &[T], inverse: &[T], x: &mut [T]) {
    let stride = x.len();
    let lanes = lanes::<T, S>();
    for j in (0..inverse.len()).step_by(3) {
        let L = [0, 1, 2].map(|c| &L[(j + c) * stride..][..stride]);
        let x0 = x[j] * inverse[j];
        let x1 = (x[j + 1] - L[0][j + 1] * x0) * inverse[j + 1];
        let x2 = (x[j + 2] - L[0][j + 2] * x0 - L[1][j + 2] * x1) * inverse[j + 2];
        // From the register of the diagonal on: what that does to this node's own entries is overwritten.
        let start = j / lanes * lanes;
        let factors = [-x0, -x1, -x2].map(|x| T::same(simd, x));
        let columns = L.map(|column| T::packs::<S>(&column[start..]));
        let packs = T::packs_mut::<S>(&mut x[start..]);
        let columns = columns.map(|column| &column[..packs.len()]);
        for (i, pack) in packs.iter_mut().enumerate() {
            for c in 0..3 {
                *pack = T::multiply_add(simd, columns[c][i], factors[c], *pack);
            }
        }
        x[j..j + 3].copy_from_slice(&[x0, x1, x2]);
    }
}

/// x = L⁻ᵀ x for the first entries of x, where the others are known.
#[inline(always)]
fn backward<T: Real, S: Simd>(simd: S, L: &[T], inverse: &[T], x: &mut [T]) {
    let stride = x.len();
    let lanes = lanes::<T, S>();
    for j in (0..inverse.len()).step_by(3).rev() {
        let L = [0, 1, 2].map(|c| &L[(j + c) * stride..][..stride]);
        let [b0, b1, b2] = [x[j], x[j + 1], x[j + 2]];
        // From the register of the diagonal on, where this node's own entries are not to count.
        x[j..j + 3].fill(T::default());
        let start = j / lanes * lanes;
        let mut sums = [T::same(simd, T::default()); 3];
        let columns = L.map(|column| T::packs::<S>(&column[start..]));
        let packs = T::packs::<S>(&x[start..]);
        let columns = columns.map(|column| &column[..packs.len()]);
        for (i, &pack) in packs.iter().enumerate() {
            for c in 0..3 {
                sums[c] = T::multiply_add(simd, columns[c][i], pack, sums[c]);
            }
        }
        let known = sums.map(|sum| T::total(simd, sum));
        let x2 = (b2 - known[2]) * inverse[j + 2];
        let x1 = (b1 - known[1] - L[1][j + 2] * x2) * inverse[j + 1];
        let x0 = (b0 - known[0] - L[0][j + 1] * x1 - L[0][j + 2] * x2) * inverse[j];
        x[j..j + 3].copy_from_slice(&[x0, x1, x2]);
    }
}
