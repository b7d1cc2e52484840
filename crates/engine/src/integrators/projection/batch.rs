//! Batches of elements without common nodes, one in each SIMD lane.

use crate::integrators::relaxation::Shape;
use fem_elements::number::Float;
use fem_elements::number::Number;
use fem_elements::tensor::{Tensor, zero};

/// As many elements as there are lanes, with no common node.
#[derive(Clone)]
pub(super) struct Batch<T: Float, const N: usize> {
    /// Gradients of the shape functions of all nodes, 1/m; the third direction of triangles is zero.
    pub gradients: [[T::Lanes; 3]; N],
    /// Volume, m³; zero in lanes without an element.
    pub volume: T::Lanes,
    /// Inverse masses of the nodes, 1/kg.
    pub inverse_masses: [[T::Lanes; 3]; N],
    /// Factor L for each coordinate, of L Lᵀ = V Σ_a m_a⁻¹ ∇φ_a⊗∇φ_a, √(m/kg).
    pub factors: [Tensor<T::Lanes>; 3],
    /// Multiplier accumulated over a step: the first Piola–Kirchhoff stress (Pa), or a scalar in the first entry (√Pa).
    pub multiplier: Tensor<T::Lanes>,
}

/// A batch of elements of these shapes, still without masses.
pub(super) fn batch<T: Float, const N: usize>(shapes: &[Option<Shape<N>>]) -> Batch<T, N> {
    let nothing = T::Lanes::zero();
    let gradient = |lane: usize, a: usize, j: usize| shapes[lane].map_or(0.0, |shape| shape.gradients[a][j]);
    let mut batch = Batch {
        gradients: [[nothing; 3]; N],
        volume: T::lanes(|lane| T::of(shapes[lane].map_or(0.0, |shape| shape.volume))),
        inverse_masses: [[nothing; 3]; N],
        factors: [zero(); 3],
        multiplier: zero(),
    };
    for a in 0..N {
        for j in 0..3 {
            batch.gradients[a][j] = T::lanes(|lane| T::of(gradient(lane, a, j)));
        }
    }
    batch
}

/// Cholesky's factor L of V Σ_a m_a⁻¹ ∇φ_a⊗∇φ_a for coordinate i. Constrained nodes leave the matrix singular, and a triangle does in
/// its third direction: a column without a pivot is zero.
pub(super) fn factor<T: Float, const N: usize>(batch: &Batch<T, N>, i: usize) -> Tensor<T::Lanes> {
    let mut L = zero::<T::Lanes>();
    for lane in 0..T::WIDTH {
        let number = |x: &T::Lanes| x.lane(lane);
        let mut A = [[T::default(); 3]; 3];
        for a in 0..N {
            let scale = number(&batch.volume) * number(&batch.inverse_masses[a][i]);
            let g = batch.gradients[a].map(|g| number(&g));
            for j in 0..3 {
                for k in 0..3 {
                    A[j][k] += scale * g[j] * g[k];
                }
            }
        }
        let smallest = T::of(64.0) * T::EPSILON * (A[0][0] + A[1][1] + A[2][2]);
        let mut l = [[T::default(); 3]; 3];
        for k in 0..3 {
            let pivot = A[k][k] - (0..k).map(|m| l[k][m] * l[k][m]).sum::<T>();
            if pivot <= smallest {
                continue;
            }
            l[k][k] = pivot.sqrt();
            for j in k + 1..3 {
                l[j][k] = (A[j][k] - (0..k).map(|m| l[j][m] * l[k][m]).sum::<T>()) / l[k][k];
            }
        }
        for j in 0..3 {
            for k in 0..3 {
                L[j][k].set_lane(lane, l[j][k]);
            }
        }
    }
    L
}
