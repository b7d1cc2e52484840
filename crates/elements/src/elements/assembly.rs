//! Assembly: loops over all elements that sum up energy, gradient and Hessian.

use std::marker::PhantomData;

use super::chunk_sums::{
    AddEnergyAndGradientOf, AddGradientOf, AddStiffnessOf, AddStiffnessTimesOf, EnergyOf, InvertedOf, MinDetFOf,
    SquaresOf, smaller,
};
use super::parallel::over_chunks;
use super::{BatchLaws, Chunk, Elements};
use crate::number::{Float, Lanes, Number};
use crate::sparse::Block;
use crate::threads::reduce;
use pulp::WithSimd;

/// Work on a chunk in the widest lanes of this processor.
macro_rules! with_widest_lanes {
    ($T:ident, $Work:ident { $($field:ident),* }) => {
        if $T::has_fast() {
            $T::Fast::vectorize($Work::<$T::Fast, D, E, N> { $($field),* })
        } else {
            $T::Single::vectorize($Work::<$T::Single, D, E, N> { $($field),* })
        }
    };
}

/// Runs work on a chunk with these lanes and laws.
#[inline(always)]
fn vectorize<L: Lanes, B: BatchLaws<L>, W: WithSimd>(work: W) -> W::Output {
    if B::IS_INLINED { L::vectorize_widest(work) } else { L::vectorize(work) }
}

impl<T: Float, const D: usize, const E: usize, const N: usize> Elements<T, D, E, N> {
    /// Elastic energy at displacements `u` of all nodes, J; not finite where the law does not allow an element.
    pub fn energy<L: Lanes<Element = T>, B: BatchLaws<L>>(&self, laws: B, u: &[[T; 3]]) -> f64 {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, _: &mut [()]| {
            vectorize::<L, B, _>(EnergyOf { lanes: PhantomData::<L>, chunk, laws, u })
        };
        over_chunks(&self.chunks, &mut [], |_| 0, &of_chunk)
    }

    /// Σ V G:G, m³: a measure of the rounding error in the energies of rotated elements. It grows with the rotation, their energies
    /// do not.
    pub fn squares(&self, u: &[[T; 3]]) -> f64 {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, _: &mut [()]| with_widest_lanes!(T, SquaresOf { chunk, u });
        over_chunks(&self.chunks, &mut [], |_| 0, &of_chunk)
    }

    /// Adds the gradient of the energy by the nodes' positions, N.
    pub fn add_gradient<L: Lanes<Element = T>, B: BatchLaws<L>>(&self, laws: B, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, sums: &mut [[T; 3]]| {
            vectorize::<L, B, _>(AddGradientOf { lanes: PhantomData::<L>, chunk, laws, u, sums });
            0.0
        };
        over_chunks(&self.chunks, gradient, |chunk| chunk.nodes.end, &of_chunk);
    }

    /// Energy and gradient in one pass.
    pub fn add_energy_and_gradient<L: Lanes<Element = T>, B: BatchLaws<L>>(
        &self,
        laws: B,
        u: &[[T; 3]],
        gradient: &mut [[T; 3]],
    ) -> f64 {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, sums: &mut [[T; 3]]| {
            vectorize::<L, B, _>(AddEnergyAndGradientOf { lanes: PhantomData::<L>, chunk, laws, u, sums })
        };
        over_chunks(&self.chunks, gradient, |chunk| chunk.nodes.end, &of_chunk)
    }

    /// Adds `factor` times the Hessian of the energy to the values of the pattern that the elements were made for, N/m.
    pub fn add_stiffness<L: Lanes<Element = T>, B: BatchLaws<L>>(
        &self,
        laws: B,
        factor: T,
        u: &[[T; 3]],
        values: &mut [Block<T, 3>],
    ) {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, values: &mut [Block<T, 3>]| {
            vectorize::<L, B, _>(AddStiffnessOf { lanes: PhantomData::<L>, chunk, laws, factor, u, values });
            0.0
        };
        over_chunks(&self.chunks, values, |chunk| chunk.blocks.end, &of_chunk);
    }

    /// Adds `factor` K(u) d, the change of the gradient along a direction, without a matrix, N.
    pub fn add_stiffness_times<L: Lanes<Element = T>, B: BatchLaws<L>>(
        &self,
        laws: B,
        factor: T,
        u: &[[T; 3]],
        d: &[[T; 3]],
        product: &mut [[T; 3]],
    ) {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, sums: &mut [[T; 3]]| {
            vectorize::<L, B, _>(AddStiffnessTimesOf { lanes: PhantomData::<L>, chunk, laws, factor, u, d, sums });
            0.0
        };
        over_chunks(&self.chunks, product, |chunk| chunk.nodes.end, &of_chunk);
    }

    /// Minimum of det F, and its element in the mesh.
    pub fn min_det_F(&self, u: &[[T; 3]]) -> (T, usize) {
        let of_chunk = |chunk: &Chunk<T, D, E, N>| with_widest_lanes!(T, MinDetFOf { chunk, u });
        let of = |chunks: &[Chunk<T, D, E, N>]| chunks.iter().map(of_chunk).fold((T::of(f64::INFINITY), 0), smaller);
        reduce(&self.chunks, 1, &of, smaller)
    }

    /// Number of elements with det F ≤ 0.
    pub fn inverted(&self, u: &[[T; 3]]) -> usize {
        self.chunks.iter().map(|chunk| with_widest_lanes!(T, InvertedOf { chunk, u })).sum()
    }
}
