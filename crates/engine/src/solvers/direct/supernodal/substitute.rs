//! Forward and backward substitution by supernodes, three columns of a node at a time.

use pulp::{Simd, WithSimd};

use super::dense::lanes;
use super::symbolic::{Supernode, SymbolicFactor};
use fem_elements::Real;
use fem_elements::vector::triple;

/// z = L⁻ᵀ L⁻¹ z
pub struct Substitute<'a, T> {
    pub symbolic: &'a SymbolicFactor,
    pub L: &'a [T],
    /// 1 / diagonal of L
    pub inverse: &'a [T],
    pub z: &'a mut [T],
    /// Workspace as long as the longest column of L.
    pub front: &'a mut [T],
}

impl<T: Real> WithSimd for Substitute<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let SymbolicFactor { supernodes, rows, .. } = self.symbolic;
        for supernode in supernodes {
            self.forward(simd, supernode, &rows[supernode.rows.clone()]);
        }
        for supernode in supernodes.iter().rev() {
            self.backward(simd, supernode, &rows[supernode.rows.clone()]);
        }
    }
}

impl<T: Real> Substitute<'_, T> {
    /// Applies L⁻¹ by the columns of a supernode.
    #[inline(always)]
    fn forward<S: Simd>(&mut self, simd: S, supernode: &Supernode, rows: &[u32]) {
        let own = 3 * supernode.nodes.start..3 * supernode.nodes.end;
        let x = &mut self.front[..supernode.stride];
        let (head, tail) = x.split_at_mut(own.len());
        head.copy_from_slice(&self.z[own.clone()]);
        tail.fill(T::default());
        forward(simd, &self.L[supernode.columns.clone()], &self.inverse[own.clone()], x);
        self.z[own.clone()].copy_from_slice(&x[..own.len()]);
        for (x, &row) in x[own.len()..].as_chunks::<3>().0.iter().zip(rows) {
            let z = &mut self.z[3 * row as usize..][..3];
            for i in 0..3 {
                z[i] += x[i];
            }
        }
    }

    /// Applies L⁻ᵀ by the columns of a supernode.
    #[inline(always)]
    fn backward<S: Simd>(&mut self, simd: S, supernode: &Supernode, rows: &[u32]) {
        let own = 3 * supernode.nodes.start..3 * supernode.nodes.end;
        let x = &mut self.front[..supernode.stride];
        let (head, tail) = x.split_at_mut(own.len());
        head.copy_from_slice(&self.z[own.clone()]);
        tail[3 * rows.len()..].fill(T::default());
        for (x, &row) in tail.as_chunks_mut::<3>().0.iter_mut().zip(rows) {
            x.copy_from_slice(&self.z[3 * row as usize..][..3]);
        }
        backward(simd, &self.L[supernode.columns.clone()], &self.inverse[own.clone()], x);
        self.z[own.clone()].copy_from_slice(&x[..own.len()]);
    }
}

/// x = L⁻¹ x for the first entries of x; subtracts their contribution from the others.
#[inline(always)]
fn forward<T: Real, S: Simd>(simd: S, L: &[T], inverse: &[T], x: &mut [T]) {
    let stride = x.len();
    let lanes = lanes::<T, S>();
    for j in (0..inverse.len()).step_by(3) {
        let L = triple(
            #[inline(always)]
            |c| &L[(j + c) * stride..][..stride],
        );
        let x0 = x[j] * inverse[j];
        let x1 = (x[j + 1] - L[0][j + 1] * x0) * inverse[j + 1];
        let x2 = (x[j + 2] - L[0][j + 2] * x0 - L[1][j + 2] * x1) * inverse[j + 2];
        // Begins at the register that holds the diagonal entry. The node's own entries are overwritten afterwards.
        let start = j / lanes * lanes;
        let factors = [T::broadcast(simd, -x0), T::broadcast(simd, -x1), T::broadcast(simd, -x2)];
        let packs = T::packs_mut::<S>(&mut x[start..]);
        let columns = triple(
            #[inline(always)]
            |c| &T::packs::<S>(&L[c][start..])[..packs.len()],
        );
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
        let L = triple(
            #[inline(always)]
            |c| &L[(j + c) * stride..][..stride],
        );
        let [b0, b1, b2] = [x[j], x[j + 1], x[j + 2]];
        // Begins at the register that holds the diagonal entry, with zeros for the node's own entries.
        x[j..j + 3].fill(T::default());
        let start = j / lanes * lanes;
        let mut sums = [T::broadcast(simd, T::default()); 3];
        let packs = T::packs::<S>(&x[start..]);
        let columns = triple(
            #[inline(always)]
            |c| &T::packs::<S>(&L[c][start..])[..packs.len()],
        );
        for (i, &pack) in packs.iter().enumerate() {
            for c in 0..3 {
                sums[c] = T::multiply_add(simd, columns[c][i], pack, sums[c]);
            }
        }
        let known = triple(
            #[inline(always)]
            |c| T::reduce_sum(simd, sums[c]),
        );
        let x2 = (b2 - known[2]) * inverse[j + 2];
        let x1 = (b1 - known[1] - L[1][j + 2] * x2) * inverse[j + 1];
        let x0 = (b0 - known[0] - L[0][j + 1] * x1 - L[0][j + 2] * x2) * inverse[j];
        x[j..j + 3].copy_from_slice(&[x0, x1, x2]);
    }
}
