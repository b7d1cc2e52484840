//! Sums over the elements of one chunk. Each is a type of its own, so that it is compiled once for each instruction set.

use std::marker::PhantomData;

use pulp::{Simd, WithSimd};

use super::kernel::{
    corner_blocks, corner_gradients, displacement_gradient, invariant_blocks, rotation_blocks, squares, total_energy,
};
use super::scatter::{add_hessian, scatter};
use super::{Batch, BatchLaws, Chunk};
use crate::materials::{Law, Terms};
use crate::number::{Float, Lanes, constant};
use crate::sparse::Block;
use crate::tensor::{map, volume_change};

/// A part of a stored batch in lanes like `one`.
#[inline(always)]
fn load<L: Lanes, const D: usize, const E: usize>(
    stored: &Batch<<L::Element as Float>::Lanes, D, E>,
    part: usize,
    one: L,
) -> Batch<L, D, E> {
    let (volume, counted) = (one.load(&stored.volume, part), one.load(&stored.counted, part));
    let mut batch = Batch { gradients: [[one; D]; E], volume, counted };
    for e in 0..E {
        for j in 0..D {
            batch.gradients[e][j] = one.load(&stored.gradients[e][j], part);
        }
    }
    batch
}

/// The batches of a chunk in parts of as many elements as there are lanes like `one`, with their corners.
#[inline(always)]
pub(super) fn batches<L: Lanes, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<L::Element, D, E, N>,
    one: L,
) -> impl Iterator<Item = (Batch<L, D, E>, &[[u32; N]])> {
    (0..chunk.batches.len() * L::PARTS)
        .map(
            #[inline(always)]
            move |i| load(&chunk.batches[i / L::PARTS], i % L::PARTS, one),
        )
        .zip(chunk.corners.chunks_exact(L::LANES))
}

/// Elastic energy of the elements that a chunk counts, J.
pub(super) struct EnergyOf<'a, L: Lanes, B, const D: usize, const E: usize, const N: usize> {
    pub lanes: PhantomData<L>,
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub laws: B,
    pub u: &'a [[L::Element; 3]],
}

impl<L: Lanes, B: BatchLaws<L>, const D: usize, const E: usize, const N: usize> WithSimd
    for EnergyOf<'_, L, B, D, E, N>
{
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let Self { chunk, laws, u, .. } = self;
        let mut total = 0.0;
        for (i, (batch, corners)) in batches(chunk, L::one()).enumerate() {
            let law = laws.of_batch(&chunk.elements, i);
            total += total_energy(&batch, law.energy(&displacement_gradient(&batch, corners, u)));
        }
        total
    }
}

/// Σ V G:G of the elements that a chunk counts, m³.
pub(super) struct SquaresOf<'a, L: Lanes, const D: usize, const E: usize, const N: usize> {
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub u: &'a [[L::Element; 3]],
}

impl<L: Lanes, const D: usize, const E: usize, const N: usize> WithSimd for SquaresOf<'_, L, D, E, N> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let Self { chunk, u } = self;
        let mut total = 0.0;
        for (batch, corners) in batches(chunk, L::one()) {
            total += squares(&batch, &displacement_gradient(&batch, corners, u));
        }
        total
    }
}

/// Adds the gradient of the energy to the rows of a chunk, N.
pub(super) struct AddGradientOf<'a, L: Lanes, B, const D: usize, const E: usize, const N: usize> {
    pub lanes: PhantomData<L>,
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub laws: B,
    pub u: &'a [[L::Element; 3]],
    pub sums: &'a mut [[L::Element; 3]],
}

impl<L: Lanes, B: BatchLaws<L>, const D: usize, const E: usize, const N: usize> WithSimd
    for AddGradientOf<'_, L, B, D, E, N>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { chunk, laws, u, sums, .. } = self;
        for (i, (batch, corners)) in batches(chunk, L::one()).enumerate() {
            let law = laws.of_batch(&chunk.elements, i);
            let G = displacement_gradient(&batch, corners, u);
            scatter(chunk, corners, &corner_gradients(&batch, &law.stress(&G)), sums);
        }
    }
}

/// Energy and gradient in one pass.
pub(super) struct AddEnergyAndGradientOf<'a, L: Lanes, B, const D: usize, const E: usize, const N: usize> {
    pub lanes: PhantomData<L>,
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub laws: B,
    pub u: &'a [[L::Element; 3]],
    pub sums: &'a mut [[L::Element; 3]],
}

impl<L: Lanes, B: BatchLaws<L>, const D: usize, const E: usize, const N: usize> WithSimd
    for AddEnergyAndGradientOf<'_, L, B, D, E, N>
{
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let Self { chunk, laws, u, sums, .. } = self;
        let mut total = 0.0;
        for (i, (batch, corners)) in batches(chunk, L::one()).enumerate() {
            let law = laws.of_batch(&chunk.elements, i);
            let G = displacement_gradient(&batch, corners, u);
            let (energy, P) = law.energy_and_stress(&G);
            total += total_energy(&batch, energy);
            scatter(chunk, corners, &corner_gradients(&batch, &P), sums);
        }
        total
    }
}

/// Adds `factor` times the Hessian of the energy to the blocks of a chunk, N/m.
pub(super) struct AddStiffnessOf<'a, L: Lanes, B, const D: usize, const E: usize, const N: usize> {
    pub lanes: PhantomData<L>,
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub laws: B,
    pub factor: L::Element,
    pub u: &'a [[L::Element; 3]],
    pub values: &'a mut [Block<L::Element, 3>],
}

impl<L: Lanes, B: BatchLaws<L>, const D: usize, const E: usize, const N: usize> WithSimd
    for AddStiffnessOf<'_, L, B, D, E, N>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { chunk, laws, factor, u, values, .. } = self;
        let factor = L::splat(factor);
        for (i, (batch, corners)) in batches(chunk, L::one()).enumerate() {
            let law = laws.of_batch(&chunk.elements, i);
            let G = displacement_gradient(&batch, corners, u);
            let mut scaled = batch;
            scaled.volume *= factor;
            let inner = match law.terms(&G) {
                Terms::Invariants(terms) => invariant_blocks(&scaled, &terms),
                Terms::Rotation(terms) => rotation_blocks(&scaled, &terms),
                Terms::Entries => corner_blocks(&scaled, &law.derivative(&G)),
            };
            add_hessian(chunk, i, &inner, values);
        }
    }
}

/// Adds `factor` times the Hessian times d to the rows of a chunk, N.
pub(super) struct AddStiffnessTimesOf<'a, L: Lanes, B, const D: usize, const E: usize, const N: usize> {
    pub lanes: PhantomData<L>,
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub laws: B,
    pub factor: L::Element,
    pub u: &'a [[L::Element; 3]],
    pub d: &'a [[L::Element; 3]],
    pub sums: &'a mut [[L::Element; 3]],
}

impl<L: Lanes, B: BatchLaws<L>, const D: usize, const E: usize, const N: usize> WithSimd
    for AddStiffnessTimesOf<'_, L, B, D, E, N>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { chunk, laws, factor, u, d, sums, .. } = self;
        let factor = L::splat(factor);
        for (i, (batch, corners)) in batches(chunk, L::one()).enumerate() {
            let law = laws.of_batch(&chunk.elements, i);
            let G = displacement_gradient(&batch, corners, u);
            let dF = displacement_gradient(&batch, corners, d);
            let dP = map(
                &law.derivative_times(&G, &dF),
                #[inline(always)]
                |entry| entry * factor,
            );
            scatter(chunk, corners, &corner_gradients(&batch, &dP), sums);
        }
    }
}

/// Minimum of det F, and its element.
pub(super) struct MinDetFOf<'a, L: Lanes, const D: usize, const E: usize, const N: usize> {
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub u: &'a [[L::Element; 3]],
}

impl<L: Lanes, const D: usize, const E: usize, const N: usize> WithSimd for MinDetFOf<'_, L, D, E, N> {
    type Output = (L::Element, usize);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> (L::Element, usize) {
        let Self { chunk, u } = self;
        let mut least = (L::Element::of(f64::INFINITY), 0);
        for ((batch, corners), elements) in batches(chunk, L::one()).zip(chunk.elements.chunks(L::LANES)) {
            let J = volume_change(&displacement_gradient(&batch, corners, u)).0 + constant(1.0);
            for (&J, &element) in J.as_slice().iter().zip(elements) {
                least = smaller(least, (J, element as usize));
            }
        }
        least
    }
}

/// The smaller of two values with their elements, the first one of equal values; NaN is the smallest of all.
#[inline(always)]
pub(crate) fn smaller<T: Float>(a: (T, usize), b: (T, usize)) -> (T, usize) {
    if b.0 >= a.0 || a.0.as_f64().is_nan() { a } else { b }
}

/// Number of the elements of a chunk with det F ≤ 0.
pub(super) struct InvertedOf<'a, L: Lanes, const D: usize, const E: usize, const N: usize> {
    pub chunk: &'a Chunk<L::Element, D, E, N>,
    pub u: &'a [[L::Element; 3]],
}

impl<L: Lanes, const D: usize, const E: usize, const N: usize> WithSimd for InvertedOf<'_, L, D, E, N> {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> usize {
        let Self { chunk, u } = self;
        let mut count = 0;
        // The lanes of the last batch that belong to no element are empty.
        for ((batch, corners), elements) in batches(chunk, L::one()).zip(chunk.elements.chunks(L::LANES)) {
            let J = volume_change(&displacement_gradient(&batch, corners, u)).0 + constant(1.0);
            for (&J, _) in J.as_slice().iter().zip(elements) {
                count += usize::from(!(J > L::Element::default()));
            }
        }
        count
    }
}
