//! Assembly: loops over all elements that sum up energy, gradient and Hessian.

use super::build::NONE;
use super::kernel::{
    LaneBlock, corner_blocks, corner_gradients, displacement_gradient, element_hessian, invariant_blocks, squares,
    total_energy,
};
use super::parallel::over_chunks;
use super::{Batch, BatchLaws, Chunk, Elements};
use crate::materials::Law;
use simba::simd::SimdValue;

use crate::number::{Real, constant};
use crate::sparse::Block;
use crate::tensor::{from_fn, volume_change};

impl<T: Real, const D: usize, const E: usize, const N: usize> Elements<T, D, E, N> {
    /// Elastic energy at displacements `u` of all nodes, J; not finite where the law does not allow an element.
    pub fn energy<B: BatchLaws<T::Lanes>>(&self, laws: B, u: &[[T; 3]]) -> f64 {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, _: &mut [()]| energy_of(chunk, laws, u);
        over_chunks(&self.chunks, &mut [], |_| 0, &of_chunk)
    }

    /// Σ V G:G, m³: a measure of the rounding error in the energies of rotated elements. It grows with the rotation, their energies
    /// do not.
    pub fn squares(&self, u: &[[T; 3]]) -> f64 {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, _: &mut [()]| squares_of(chunk, u);
        over_chunks(&self.chunks, &mut [], |_| 0, &of_chunk)
    }

    /// Adds the gradient of the energy by the nodes' positions, N.
    pub fn add_gradient<B: BatchLaws<T::Lanes>>(&self, laws: B, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, sums: &mut [[T; 3]]| {
            add_gradient_of(chunk, laws, u, sums);
            0.0
        };
        over_chunks(&self.chunks, gradient, |chunk| chunk.nodes.end, &of_chunk);
    }

    /// Energy and gradient in one pass.
    pub fn add_energy_and_gradient<B: BatchLaws<T::Lanes>>(
        &self,
        laws: B,
        u: &[[T; 3]],
        gradient: &mut [[T; 3]],
    ) -> f64 {
        let of_chunk =
            |chunk: &Chunk<T, D, E, N>, sums: &mut [[T; 3]]| add_energy_and_gradient_of(chunk, laws, u, sums);
        over_chunks(&self.chunks, gradient, |chunk| chunk.nodes.end, &of_chunk)
    }

    /// Adds `factor` times the Hessian of the energy to the values of the pattern that the elements were made for, N/m.
    pub fn add_stiffness<B: BatchLaws<T::Lanes>>(&self, laws: B, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, values: &mut [Block<T, 3>]| {
            add_stiffness_of(chunk, laws, factor, u, values);
            0.0
        };
        over_chunks(&self.chunks, values, |chunk| chunk.blocks.end, &of_chunk);
    }

    /// Adds `factor` K(u) d, the change of the gradient along a direction, without a matrix, N.
    pub fn add_stiffness_times<B: BatchLaws<T::Lanes>>(
        &self,
        laws: B,
        factor: T,
        u: &[[T; 3]],
        d: &[[T; 3]],
        product: &mut [[T; 3]],
    ) {
        let of_chunk = |chunk: &Chunk<T, D, E, N>, sums: &mut [[T; 3]]| {
            add_stiffness_times_of(chunk, laws, factor, u, d, sums);
            0.0
        };
        over_chunks(&self.chunks, product, |chunk| chunk.nodes.end, &of_chunk);
    }

    /// Minimum of det F, and its element in the mesh.
    pub fn min_det_F(&self, u: &[[T; 3]]) -> (T, usize) {
        let mut least = (T::of(f64::INFINITY), 0);
        for chunk in &self.chunks {
            let (J, element) = min_det_F_of(chunk, u);
            if !(least.0 <= J) {
                least = (J, element);
            }
        }
        least
    }

    /// Number of elements with det F ≤ 0.
    pub fn inverted(&self, u: &[[T; 3]]) -> usize {
        let of_batch = |chunk: &Chunk<T, D, E, N>, number: usize, (batch, corners)| {
            let J = volume_change(&displacement_gradient(batch, corners, u)).0 + constant(1.0);
            // The lanes of the last batch that belong to no element are empty.
            let elements = chunk.elements.len() - number * T::WIDTH;
            T::each(&J).iter().take(elements).filter(|&&J| !(J > T::default())).count()
        };
        let of_chunk =
            |chunk| -> usize { batches(chunk).enumerate().map(|(number, batch)| of_batch(chunk, number, batch)).sum() };
        self.chunks.iter().map(of_chunk).sum()
    }
}

/// Adds what the corners of a batch contribute to the nodes of its chunk.
#[inline(always)]
fn scatter<T: Real, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    corners: &[[u32; N]],
    gradients: &[[T::Lanes; D]; E],
    sums: &mut [[T; 3]],
) {
    let first = chunk.nodes.start as u32;
    // Bounded by a constant, so that no lane needs to be checked.
    for lane in 0..T::WIDTH {
        let corners = &corners[lane];
        let mut of_first = [T::default(); D];
        for e in 0..E {
            let value: [T; D] = std::array::from_fn(|i| T::each(&gradients[e][i])[lane]);
            for i in 0..D {
                of_first[i] -= value[i];
            }
            // A node of another chunk is out of range.
            if let Some(sum) = sums.get_mut(corners[e + 1].wrapping_sub(first) as usize) {
                for i in 0..D {
                    sum[i] += value[i];
                }
            }
        }
        if let Some(sum) = sums.get_mut(corners[0].wrapping_sub(first) as usize) {
            for i in 0..D {
                sum[i] += of_first[i];
            }
        }
    }
}

/// Adds the Hessian of a batch, of which the blocks of all corners but the first are given, to the rows of its chunk.
#[inline(always)]
fn add_hessian<T: Real, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    batch: usize,
    inner: &[[LaneBlock<T, D>; E]; E],
    values: &mut [Block<T, 3>],
) {
    let hessian = element_hessian::<T, D, E, N>(inner);
    let targets = &chunk.targets[batch * T::WIDTH..(batch + 1) * T::WIDTH];
    for a in 0..N {
        for b in 0..=a {
            // A pair without a block, or whose row belongs to another chunk, is out of range.
            T::add_by_lane(&hessian[a][b], values, |lane| targets[lane][a][b]);
            if a != b && targets.iter().any(|targets| targets[b][a] != NONE) {
                let transposed = std::array::from_fn(|i| std::array::from_fn(|k| hessian[a][b][k][i]));
                T::add_by_lane(&transposed, values, |lane| targets[lane][b][a]);
            }
        }
    }
}

/// The batches of a chunk, with their corners.
#[inline(always)]
fn batches<T: Real, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
) -> impl Iterator<Item = (&Batch<T, D, E>, &[[u32; N]])> {
    chunk.batches.iter().zip(chunk.corners.chunks_exact(T::WIDTH))
}

fn energy_of<T: Real, B: BatchLaws<T::Lanes>, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    laws: B,
    u: &[[T; 3]],
) -> f64 {
    let of_batch = |(i, (batch, corners))| {
        let law = laws.of_batch(&chunk.elements, i);
        total_energy(batch, law.energy(&displacement_gradient(batch, corners, u)))
    };
    batches(chunk).enumerate().map(of_batch).sum()
}

fn squares_of<T: Real, const D: usize, const E: usize, const N: usize>(chunk: &Chunk<T, D, E, N>, u: &[[T; 3]]) -> f64 {
    let of_batch = |(batch, corners)| squares(batch, &displacement_gradient(batch, corners, u));
    batches(chunk).map(of_batch).sum()
}

fn add_gradient_of<T: Real, B: BatchLaws<T::Lanes>, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    laws: B,
    u: &[[T; 3]],
    sums: &mut [[T; 3]],
) {
    for (i, (batch, corners)) in batches(chunk).enumerate() {
        let law = laws.of_batch(&chunk.elements, i);
        let G = displacement_gradient(batch, corners, u);
        scatter(chunk, corners, &corner_gradients(batch, &law.stress(&G)), sums);
    }
}

fn add_energy_and_gradient_of<T: Real, B: BatchLaws<T::Lanes>, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    laws: B,
    u: &[[T; 3]],
    sums: &mut [[T; 3]],
) -> f64 {
    let mut total = 0.0;
    for (i, (batch, corners)) in batches(chunk).enumerate() {
        let law = laws.of_batch(&chunk.elements, i);
        let G = displacement_gradient(batch, corners, u);
        let (energy, P) = law.energy_and_stress(&G);
        total += total_energy(batch, energy);
        scatter(chunk, corners, &corner_gradients(batch, &P), sums);
    }
    total
}

fn add_stiffness_of<T: Real, B: BatchLaws<T::Lanes>, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    laws: B,
    factor: T,
    u: &[[T; 3]],
    values: &mut [Block<T, 3>],
) {
    let factor = T::Lanes::splat(factor);
    for (i, (batch, corners)) in batches(chunk).enumerate() {
        let law = laws.of_batch(&chunk.elements, i);
        let G = displacement_gradient(batch, corners, u);
        let mut scaled = *batch;
        scaled.volume *= factor;
        let inner = match law.of_invariants(&G) {
            Some(terms) => invariant_blocks(&scaled, &terms),
            None => corner_blocks(&scaled, &law.derivative(&G)),
        };
        add_hessian(chunk, i, &inner, values);
    }
}

fn add_stiffness_times_of<T: Real, B: BatchLaws<T::Lanes>, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    laws: B,
    factor: T,
    u: &[[T; 3]],
    d: &[[T; 3]],
    sums: &mut [[T; 3]],
) {
    let factor = T::Lanes::splat(factor);
    for (i, (batch, corners)) in batches(chunk).enumerate() {
        let law = laws.of_batch(&chunk.elements, i);
        let G = displacement_gradient(batch, corners, u);
        let dF = displacement_gradient(batch, corners, d);
        let H = law.derivative(&G);
        let dP = from_fn(
            #[inline(always)]
            |i, j| {
                let mut sum = H[3 * i + j][0] * dF[0][0];
                for c in 1..9 {
                    sum += H[3 * i + j][c] * dF[c / 3][c % 3];
                }
                sum * factor
            },
        );
        scatter(chunk, corners, &corner_gradients(batch, &dP), sums);
    }
}

fn min_det_F_of<T: Real, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<T, D, E, N>,
    u: &[[T; 3]],
) -> (T, usize) {
    let mut least = (T::of(f64::INFINITY), 0);
    for ((batch, corners), elements) in batches(chunk).zip(chunk.elements.chunks(T::WIDTH)) {
        let J = volume_change(&displacement_gradient(batch, corners, u)).0 + constant(1.0);
        for (&J, &element) in T::each(&J).iter().zip(elements) {
            // NaN is the smallest of all.
            if !(least.0 <= J) {
                least = (J, element as usize);
            }
        }
    }
    least
}
