//! Stresses from displacements.

use super::Elements;
use super::kernel::displacement_gradient;
use crate::materials::{AnyLaw, cauchy_stress};
use crate::number::Real;
use crate::tensor::Tensor;

impl<T: Real, const D: usize, const N: usize> Elements<T, D, N> {
    /// Cauchy stress of each element of the mesh, Pa. Deformation gradients come from displacements, which keep their digits far from
    /// the origin and near rest.
    pub fn cauchy_stresses(&self, law: &AnyLaw<T::Lanes>, u: &[[T; 3]]) -> Vec<Tensor<f64>> {
        let mut stresses = vec![[[0.0; 3]; 3]; self.count];
        for chunk in &self.chunks {
            let batches = chunk.batches.iter().zip(chunk.corners.chunks_exact(T::WIDTH));
            for ((batch, corners), elements) in batches.zip(chunk.elements.chunks(T::WIDTH)) {
                let stress = cauchy_stress(law, &displacement_gradient(batch, corners, u));
                for (lane, &element) in elements.iter().enumerate() {
                    stresses[element as usize] = stress.map(|row| row.map(|entry| T::each(&entry)[lane].as_f64()));
                }
            }
        }
        stresses
    }
}
