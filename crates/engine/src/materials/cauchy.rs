//! Cauchy stress: force per deformed area, as files and users want it.

use super::AnyLaw;
use crate::number::Number;
use crate::tensor::{Tensor, plus_identity, product, transpose, volume_change};

/// Cauchy stress P Fᵀ/J, Pa; P itself for a linear law, which does not distinguish deformed from undeformed area. Not finite
/// for J = 0.
pub fn cauchy_stress<T: Number>(law: &AnyLaw<T>, G: &Tensor<T>) -> Tensor<T> {
    let P = law.as_law().stress(G);
    if law.is_linear() {
        return P;
    }
    pushed_forward(&P, G)
}

/// Cauchy stress P Fᵀ/J of a first Piola–Kirchhoff stress, Pa. Not finite for J = 0.
pub fn pushed_forward<T: Number>(P: &Tensor<T>, G: &Tensor<T>) -> Tensor<T> {
    let J = T::one() + volume_change(G).0;
    product(P, &transpose(&plus_identity(G))).map(|row| row.map(|entry| entry / J))
}
