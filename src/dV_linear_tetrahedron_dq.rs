use nalgebra::{DVector, Matrix3, SVector, Vector3};

use crate::given::deformation_gradient;
use crate::{dphi_linear_tetrahedron_dX, dpsi_neo_hookean_dF, quadrature_single_point};

/// Gradient of an element's elastic energy, N; entries 3i to 3i + 2 belong to vertex `element[i]`.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    quadrature_single_point(V, element, volume, |X| {
        let dphi = dphi_linear_tetrahedron_dX(V, element, X);
        let F = deformation_gradient(q, element, &dphi);
        let P = Matrix3::from_row_slice(dpsi_neo_hookean_dF(&F, C, D).as_slice());

        // F = Σ q_a ∇φ_aᵀ, so ∂ψ/∂q_a = P ∇φ_a: column a of this 3×4 matrix.
        let gradient = P * dphi.transpose();
        SVector::<f64, 12>::from_column_slice(gradient.as_slice())
    })
}
