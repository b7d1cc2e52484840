//! Cauchy stress: force per deformed area, as files and users want it.

use super::AnyLaw;
use crate::number::{Number, constant};
use crate::tensor::{Tensor, plus_identity, product, transpose, volume_change};

/// Cauchy stress P Fᵀ/J, Pa, of the first Piola–Kirchhoff stress P of a law; P itself for a linear law, which does not distinguish deformed from undeformed area. Not finite
/// for J = 0.
pub fn cauchy_stress<T: Number>(law: &AnyLaw<T>, P: &Tensor<T>, G: &Tensor<T>) -> Tensor<T> {
    if law.is_linear() { *P } else { pushed_forward(P, G) }
}

/// Cauchy stress P Fᵀ/J of a first Piola–Kirchhoff stress, Pa. Not finite for J = 0.
pub fn pushed_forward<T: Number>(P: &Tensor<T>, G: &Tensor<T>) -> Tensor<T> {
    let J = T::one() + volume_change(G).0;
    product(P, &transpose(&plus_identity(G))).map(|row| row.map(|entry| entry / J))
}

/// Cauchy stress of a body in plane stress, Pa, for a law with the reduced λ. The stress across the plane is zero. The law without reduction has
/// 2μ e₃ + λ (e₁ + e₂ + e₃) = 0 there, so that e₃ = −λ*/(2μ) (e₁ + e₂): minus the stress that the reduced law would have, over 2μ.
pub fn plane_cauchy_stress<T: Number>(law: &AnyLaw<T>, P: &Tensor<T>, G: &Tensor<T>) -> Tensor<T> {
    let (mut P, mut G) = (*P, *G);
    G[2][2] = -P[2][2] / constant(2.0 * law.moduli()[0]);
    P[2][2] = T::zero();
    if law.is_linear() { P } else { pushed_forward(&P, &G) }
}
