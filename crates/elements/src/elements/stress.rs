//! Stresses and displacement gradients of single elements.

use super::chunk_sums::batches;
use super::kernel::displacement_gradient;
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
            let numbered = batches(chunk, L::one()).zip(chunk.elements.chunks(L::LANES));
            for (i, ((batch, corners), elements)) in numbered.enumerate() {
                let law = laws.of_batch(&chunk.elements, i);
                let stress = stress(&law, &displacement_gradient(&batch, corners, u));
                for (lane, &element) in elements.iter().enumerate() {
                    stresses[element as usize] = of_lane(&stress, lane);
                }
            }
        }
        stresses
    }

    /// Calls `visit` once for each element, with its number, its volume (m³, times its factor) and its displacement gradient.
    pub fn for_each_gradient(&self, u: &[[T; 3]], mut visit: impl FnMut(usize, f64, &Tensor<f64>)) {
        for chunk in &self.chunks {
            for ((batch, corners), &element) in batches(chunk, T::Single::one()).zip(&chunk.elements) {
                // Elements between chunks are in several, and one of these counts them.
                let volume = batch.counted.lane(0).as_f64();
                if volume > 0.0 {
                    visit(element as usize, volume, &of_lane(&displacement_gradient(&batch, corners, u), 0));
                }
            }
        }
    }
}

fn of_lane<L: Lanes>(a: &Tensor<L>, lane: usize) -> Tensor<f64> {
    map(a, |entry| entry.lane(lane).as_f64())
}
