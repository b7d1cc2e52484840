//! Stresses and displacement gradients of single elements.

use super::Elements;
use super::kernel::displacement_gradient;
use crate::number::Real;
use crate::tensor::Tensor;

impl<T: Real, const D: usize, const E: usize, const N: usize> Elements<T, D, E, N> {
    /// Cauchy stress of each element, Pa: that which `stress` finds for the elements of a chunk, the number of a batch and its
    /// displacement gradients. They come from displacements, which keep their digits far from the origin and near rest.
    pub fn cauchy_stresses(
        &self,
        u: &[[T; 3]],
        stress: impl Fn(&[u32], usize, &Tensor<T::Lanes>) -> Tensor<T::Lanes>,
    ) -> Vec<Tensor<f64>> {
        let mut stresses = vec![[[0.0; 3]; 3]; self.count];
        for chunk in &self.chunks {
            let batches = chunk.batches.iter().zip(chunk.corners.chunks_exact(T::WIDTH));
            for (i, ((batch, corners), elements)) in batches.zip(chunk.elements.chunks(T::WIDTH)).enumerate() {
                let stress = stress(&chunk.elements, i, &displacement_gradient(batch, corners, u));
                for (lane, &element) in elements.iter().enumerate() {
                    stresses[element as usize] = of_lane::<T>(&stress, lane);
                }
            }
        }
        stresses
    }

    /// Calls `visit` once for each element, with its number, its volume (m³, times its factor) and its displacement gradient.
    pub fn for_each_gradient(&self, u: &[[T; 3]], mut visit: impl FnMut(usize, f64, &Tensor<f64>)) {
        for chunk in &self.chunks {
            let batches = chunk.batches.iter().zip(chunk.corners.chunks_exact(T::WIDTH));
            for ((batch, corners), elements) in batches.zip(chunk.elements.chunks(T::WIDTH)) {
                let G = displacement_gradient(batch, corners, u);
                for (lane, &element) in elements.iter().enumerate() {
                    // Elements between chunks are in several, and one of these counts them.
                    let volume = T::each(&batch.counted)[lane].as_f64();
                    if volume > 0.0 {
                        visit(element as usize, volume, &of_lane::<T>(&G, lane));
                    }
                }
            }
        }
    }
}

fn of_lane<T: Real>(a: &Tensor<T::Lanes>, lane: usize) -> Tensor<f64> {
    a.map(|row| row.map(|entry| T::each(&entry)[lane].as_f64()))
}
