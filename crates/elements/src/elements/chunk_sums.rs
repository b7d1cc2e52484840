//! Sums over the elements of one chunk. Each is a type of its own, so that it is compiled once for each instruction set.

use std::marker::PhantomData;

use pulp::{Simd, WithSimd};

use super::kernel::{
    add_corner_blocks, add_corner_gradients, add_invariant_blocks, add_rotation_blocks, corner_differences,
    displacement_gradient, no_blocks, squares, total_energy,
};
use super::scatter::{add_hessian, scatter};
use super::{Batch, BatchLaws, Chunk, Elements};
use crate::materials::{Law, Terms};
use crate::number::{Float, Lanes, constant};
use crate::sparse::Block;
use crate::tensor::{map, volume_change};

impl<T: Float, const D: usize, const E: usize, const N: usize> Elements<T, D, E, N> {
    /// Number of quadrature points whose contributions are added up before they are scattered. Points of other elements are elements of their
    /// own.
    pub(super) const POINTS: usize = if N == 10 { 4 } else { 1 };
}

/// The corners of the elements of a chunk, in parts of as many as there are lanes like those of `L`, with the number of each part.
#[inline(always)]
pub(super) fn parts<L: Lanes, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<L::Element, D, E, N>,
) -> impl Iterator<Item = (usize, &[[u32; N]])> {
    chunk.corners.chunks_exact(L::LANES).enumerate()
}

/// The number of the batch with a quadrature point of a part: batches have the first points of their elements, then the second ones.
#[inline(always)]
pub(super) fn batch_of<L: Lanes, const D: usize, const E: usize, const N: usize>(part: usize, point: usize) -> usize {
    let points = Elements::<L::Element, D, E, N>::POINTS;
    part / L::PARTS * points * L::PARTS + point * L::PARTS + part % L::PARTS
}

/// A batch of a chunk in lanes like `one`.
#[inline(always)]
pub(super) fn load<L: Lanes, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<L::Element, D, E, N>,
    batch: usize,
    one: L,
) -> Batch<L, D, E> {
    let (stored, part) = (&chunk.batches[batch / L::PARTS], batch % L::PARTS);
    let (volume, counted) = (one.load(&stored.volume, part), one.load(&stored.counted, part));
    let mut batch = Batch { gradients: [[one; D]; E], volume, counted };
    for e in 0..E {
        for j in 0..D {
            batch.gradients[e][j] = one.load(&stored.gradients[e][j], part);
        }
    }
    batch
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                let law = laws.of_batch(&chunk.elements, number);
                total += total_energy(&batch, law.energy(&displacement_gradient(&batch, &moved)));
            }
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                total += squares(&batch, &displacement_gradient(&batch, &moved));
            }
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            let mut gradients = [[one; D]; E];
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                let law = laws.of_batch(&chunk.elements, number);
                let P = law.stress(&displacement_gradient(&batch, &moved));
                add_corner_gradients(&batch, &P, point == 0, &mut gradients);
            }
            scatter(chunk, corners, &gradients, sums);
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            let mut gradients = [[one; D]; E];
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                let law = laws.of_batch(&chunk.elements, number);
                let (energy, P) = law.energy_and_stress(&displacement_gradient(&batch, &moved));
                total += total_energy(&batch, energy);
                add_corner_gradients(&batch, &P, point == 0, &mut gradients);
            }
            scatter(chunk, corners, &gradients, sums);
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            let mut inner = no_blocks();
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                let law = laws.of_batch(&chunk.elements, number);
                let G = displacement_gradient(&batch, &moved);
                let mut scaled = batch;
                scaled.volume *= factor;
                match law.terms(&G) {
                    Terms::Invariants(terms) => add_invariant_blocks(&scaled, &terms, point == 0, &mut inner),
                    Terms::Rotation(terms) => add_rotation_blocks(&scaled, &terms, point == 0, &mut inner),
                    Terms::Entries => add_corner_blocks(&scaled, &law.derivative(&G), point == 0, &mut inner),
                }
            }
            add_hessian(chunk, part, &inner, values);
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            let along = corner_differences(one, corners, d);
            let mut gradients = [[one; D]; E];
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                let law = laws.of_batch(&chunk.elements, number);
                let G = displacement_gradient(&batch, &moved);
                let dF = displacement_gradient(&batch, &along);
                let dP = map(
                    &law.derivative_times(&G, &dF),
                    #[inline(always)]
                    |entry| entry * factor,
                );
                add_corner_gradients(&batch, &dP, point == 0, &mut gradients);
            }
            scatter(chunk, corners, &gradients, sums);
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                let J = volume_change(&displacement_gradient(&batch, &moved)).0 + constant(1.0);
                for (&J, &element) in J.as_slice().iter().zip(&chunk.elements[number * L::LANES..]) {
                    least = smaller(least, (J, element as usize));
                }
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
        let one = L::one();
        for (part, corners) in parts::<L, D, E, N>(chunk) {
            let moved = corner_differences(one, corners, u);
            for point in 0..Elements::<L::Element, D, E, N>::POINTS {
                let number = batch_of::<L, D, E, N>(part, point);
                let batch = load(chunk, number, one);
                let J = volume_change(&displacement_gradient(&batch, &moved)).0 + constant(1.0);
                // A copy of an element, without volume, is not counted.
                for (&J, &volume) in J.as_slice().iter().zip(batch.volume.as_slice()) {
                    count += usize::from(!(J > L::Element::default()) && volume > L::Element::default());
                }
            }
        }
        count
    }
}
