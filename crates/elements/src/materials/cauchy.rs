//! Cauchy stress: force per deformed area, for files and users. A linear law does not distinguish deformed from undeformed area, so
//! that its first Piola–Kirchhoff stress is its Cauchy stress.

use crate::number::{Number, constant};
use crate::tensor::{Tensor, map, plus_identity, product, transpose, volume_change};

/// Cauchy stress P Fᵀ/J of a first Piola–Kirchhoff stress, Pa. Not finite for J = 0.
pub fn cauchy_stress<T: Number>(P: &Tensor<T>, G: &Tensor<T>) -> Tensor<T> {
    let J = T::one() + volume_change(G).0;
    map(
        &product(P, &transpose(&plus_identity(G))),
        #[inline(always)]
        |entry| entry / J,
    )
}

/// First Piola–Kirchhoff stress (Pa) and displacement gradient of a body in plane stress, of a law with this shear modulus (Pa) and the
/// reduced λ. The stress across the plane is zero. The law without reduction has 2μ e₃ + λ (e₁ + e₂ + e₃) = 0 there, so that
/// e₃ = −λ*/(2μ) (e₁ + e₂): minus the stress that the reduced law would have, over 2μ.
pub fn in_plane_stress<T: Number>(shear_modulus: f64, P: &Tensor<T>, G: &Tensor<T>) -> (Tensor<T>, Tensor<T>) {
    let (mut P, mut G) = (*P, *G);
    G[2][2] = -P[2][2] / constant(2.0 * shear_modulus);
    P[2][2] = T::zero();
    (P, G)
}
