//! Stresses and displacement gradients of single elements.

use super::chunk_sums::{batch_of, load, parts};
use super::kernel::{corner_differences, displacement_gradient};
use super::{BatchLaws, Elements};
use crate::materials::Law;
use crate::number::{Float, Lanes, Number};
use crate::tensor::{Tensor, map};

/// The Cauchy stress of a batch (Pa) by its law and its displacement gradients.
type StressOf<'a, L> = &'a dyn Fn(&dyn Law<L>, &Tensor<L>) -> Tensor<L>;

impl<T: Float, const D: usize, const E: usize, const N: usize> Elements<T, D, E, N> {
    /// Cauchy stress of each element, Pa: that which `stress` finds for the law and the displacement gradients of a batch. They come from
    /// displacements, which keep their digits far from the origin and near rest.
    pub fn cauchy_stresses<L: Lanes<Element = T>, B: BatchLaws<L>>(
        &self,
        laws: B,
        u: &[[T; 3]],
        stress: StressOf<L>,
    ) -> Vec<Tensor<f64>> {
        let mut stresses = vec![[[0.0; 3]; 3]; self.count];
        for chunk in &self.chunks {
            let one = L::one();
            for (part, corners) in parts::<L, D, E, N>(chunk) {
                let moved = corner_differences(one, corners, u);
                for point in 0..Self::POINTS {
                    let number = batch_of::<L, D, E, N>(part, point);
                    let law = laws.of_batch(&chunk.elements, number);
                    let stress = stress(&law, &displacement_gradient(&load(chunk, number, one), &moved));
                    for (lane, &element) in chunk.elements[number * L::LANES..].iter().enumerate().take(L::LANES) {
                        stresses[element as usize] = of_lane(&stress, lane);
                    }
                }
            }
        }
        stresses
    }

    /// Calls `visit` once for each element, with its number, its volume (m³, times its factor) and its displacement gradient.
    pub fn for_each_gradient(&self, u: &[[T; 3]], mut visit: impl FnMut(usize, f64, &Tensor<f64>)) {
        for chunk in &self.chunks {
            let one = T::Single::one();
            for (part, corners) in parts::<T::Single, D, E, N>(chunk) {
                let moved = corner_differences(one, corners, u);
                for point in 0..Self::POINTS {
                    let number = batch_of::<T::Single, D, E, N>(part, point);
                    let batch = load(chunk, number, one);
                    // Elements between chunks are in several, and one of these counts them.
                    let volume = batch.counted.lane(0).as_f64();
                    if volume > 0.0 {
                        let G = of_lane(&displacement_gradient(&batch, &moved), 0);
                        visit(chunk.elements[number] as usize, volume, &G);
                    }
                }
            }
        }
    }
}

fn of_lane<L: Lanes>(a: &Tensor<L>, lane: usize) -> Tensor<f64> {
    map(a, |entry| entry.lane(lane).as_f64())
}
