//! Stress as it is written to files: force per deformed area, and its one-number summary.

use super::{Law, Material, with_law};
use crate::tensor::{Tensor, plus_identity, product, transpose, volume_change};

/// Cauchy stress P Fᵀ/J, Pa; for the linear law, which knows no deformed area, P itself. Not finite where an element is flat.
pub fn cauchy_stress(material: &Material<f64>, G: &Tensor<f64>) -> Tensor<f64> {
    let P = with_law!(*material, law: f64 => law.stress(G));
    if let Material::Linear(_) = material {
        return P;
    }
    let (j, _) = volume_change(G);
    product(&P, &transpose(&plus_identity(G))).map(|row| row.map(|entry| entry / (1.0 + j)))
}

/// √(3/2 s:s), Pa, s the deviator of a symmetric stress: von Mises, Mechanik der festen Körper im plastisch-deformablen
/// Zustand (1913).
pub fn von_mises(stress: &Tensor<f64>) -> f64 {
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = *stress;
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * normal + 3.0 * (xy * xy + yz * yz + xz * xz)).sqrt()
}
