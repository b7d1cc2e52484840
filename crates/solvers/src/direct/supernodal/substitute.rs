//! Forward and backward substitution by supernodes, three columns at a time.

use pulp::{Simd, WithSimd};

use super::products::lanes;
use super::symbolic::{Supernode, SymbolicFactor};
use fem_elements::Real;

/// z = L⁻ᵀ S L⁻¹ z, or z = U⁻¹ L⁻¹ P⁻¹ z
pub struct Substitute<'a, T, const D: usize> {
    pub symbolic: &'a SymbolicFactor,
    /// The columns of L, and 1 / its diagonal in postorder.
    pub forward: (&'a [T], &'a [T]),
    /// The same, or those of Uᵀ.
    pub backward: (&'a [T], &'a [T]),
    /// The diagonal of S, in postorder; empty for S = 1.
    pub signs: &'a [T],
    /// The row of its supernode with which each row was exchanged, one after the other, in postorder; empty for P = 1.
    pub swaps: &'a [u32],
    pub z: &'a mut [T],
    /// Workspace as long as the longest column of L.
    pub front: &'a mut [T],
}

impl<T: Real, const D: usize> WithSimd for Substitute<'_, T, D> {
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

impl<T: Real, const D: usize> Substitute<'_, T, D> {
    /// Applies S L⁻¹, or L⁻¹ P⁻¹, by the columns of a supernode.
    #[inline(always)]
    fn forward<S: Simd>(&mut self, simd: S, supernode: &Supernode, rows: &[u32]) {
        let own = D * supernode.nodes.start..D * supernode.nodes.end;
        let x = &mut self.front[..supernode.stride];
        let (head, tail) = x.split_at_mut(own.len());
        head.copy_from_slice(&self.z[own.clone()]);
        tail.fill(T::default());
        for (i, &other) in self.swaps.get(supernode.diagonal.clone()).into_iter().flatten().enumerate() {
            head.swap(i, other as usize);
        }
        let inverse = &self.forward.1[supernode.diagonal.clone()];
        let L = &self.forward.0[supernode.columns.clone()];
        let in_threes = own.len() / 3 * 3;
        (0..in_threes).step_by(3).for_each(
            #[inline(always)]
            |j| forward::<T, S, 3>(simd, L, inverse, x, j),
        );
        (in_threes..own.len()).for_each(
            #[inline(always)]
            |j| forward::<T, S, 1>(simd, L, inverse, x, j),
        );
        for (x, &row) in x[own.len()..].as_chunks::<D>().0.iter().zip(rows) {
            let z = &mut self.z[D * row as usize..][..D];
            for i in 0..D {
                z[i] += x[i];
            }
        }
        let z = &mut self.z[own];
        z.copy_from_slice(&x[..z.len()]);
        if let Some(signs) = self.signs.get(supernode.diagonal.clone()) {
            z.iter_mut().zip(signs).for_each(|(z, &sign)| *z *= sign);
        }
    }

    /// Applies L⁻ᵀ, or U⁻¹, by the columns of a supernode.
    #[inline(always)]
    fn backward<S: Simd>(&mut self, simd: S, supernode: &Supernode, rows: &[u32]) {
        let own = D * supernode.nodes.start..D * supernode.nodes.end;
        let x = &mut self.front[..supernode.stride];
        let (head, tail) = x.split_at_mut(own.len());
        head.copy_from_slice(&self.z[own.clone()]);
        tail[D * rows.len()..].fill(T::default());
        for (x, &row) in tail.as_chunks_mut::<D>().0.iter_mut().zip(rows) {
            x.copy_from_slice(&self.z[D * row as usize..][..D]);
        }
        let inverse = &self.backward.1[supernode.diagonal.clone()];
        let L = &self.backward.0[supernode.columns.clone()];
        let in_threes = own.len() / 3 * 3;
        (in_threes..own.len()).rev().for_each(
            #[inline(always)]
            |j| backward::<T, S, 1>(simd, L, inverse, x, j),
        );
        (0..in_threes).step_by(3).rev().for_each(
            #[inline(always)]
            |j| backward::<T, S, 3>(simd, L, inverse, x, j),
        );
        self.z[own.clone()].copy_from_slice(&x[..own.len()]);
    }
}

/// x = L⁻¹ x for the N entries of x from j on; subtracts their contribution from the others.
#[inline(always)]
fn forward<T: Real, S: Simd, const N: usize>(simd: S, L: &[T], inverse: &[T], x: &mut [T], j: usize) {
    let L: [&[T]; N] = columns(L, x.len(), j);
    let (mut own, mut factors) = ([T::default(); N], [T::broadcast(simd, T::default()); N]);
    for c in 0..N {
        own[c] = x[j + c];
        for k in 0..c {
            own[c] -= L[k][j + c] * own[k];
        }
        own[c] *= inverse[j + c];
        factors[c] = T::broadcast(simd, -own[c]);
    }
    // Begins at the register that holds the diagonal entry. The own entries are overwritten afterwards.
    let start = j / lanes::<T, S>() * lanes::<T, S>();
    let packs = T::packs_mut::<S>(&mut x[start..]);
    let columns = packs_of::<T, S, N>(L, start, packs.len());
    for (i, pack) in packs.iter_mut().enumerate() {
        for c in 0..N {
            *pack = T::multiply_add(simd, columns[c][i], factors[c], *pack);
        }
    }
    x[j..j + N].copy_from_slice(&own);
}

/// x = L⁻ᵀ x for the N entries of x from j on, where those after them are known.
#[inline(always)]
fn backward<T: Real, S: Simd, const N: usize>(simd: S, L: &[T], inverse: &[T], x: &mut [T], j: usize) {
    let L: [&[T]; N] = columns(L, x.len(), j);
    let mut own = [T::default(); N];
    own.copy_from_slice(&x[j..j + N]);
    // Begins at the register that holds the diagonal entry, with zeros for the own entries.
    x[j..j + N].fill(T::default());
    let start = j / lanes::<T, S>() * lanes::<T, S>();
    let mut sums = [T::broadcast(simd, T::default()); N];
    let packs = T::packs::<S>(&x[start..]);
    let columns = packs_of::<T, S, N>(L, start, packs.len());
    for (i, &pack) in packs.iter().enumerate() {
        for c in 0..N {
            sums[c] = T::multiply_add(simd, columns[c][i], pack, sums[c]);
        }
    }
    for c in (0..N).rev() {
        own[c] -= T::reduce_sum(simd, sums[c]);
        for k in c + 1..N {
            own[c] -= L[c][j + k] * own[k];
        }
        own[c] *= inverse[j + c];
    }
    x[j..j + N].copy_from_slice(&own);
}

/// N columns of L from the j-th on. A loop: the compiler does not always inline the functions of arrays.
#[inline(always)]
fn columns<T, const N: usize>(L: &[T], stride: usize, j: usize) -> [&[T]; N] {
    let mut columns = [L; N];
    for c in 0..N {
        columns[c] = &L[(j + c) * stride..][..stride];
    }
    columns
}

/// So many packs of N columns from this row on.
#[inline(always)]
fn packs_of<T: Real, S: Simd, const N: usize>(L: [&[T]; N], start: usize, count: usize) -> [&[T::Pack<S>]; N] {
    let mut packs = [T::packs::<S>(L[0]); N];
    for c in 0..N {
        packs[c] = &T::packs::<S>(&L[c][start..])[..count];
    }
    packs
}
