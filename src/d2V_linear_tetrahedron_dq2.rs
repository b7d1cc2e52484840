use nalgebra::{DVector, SMatrix, Vector3};

use crate::given::deformation_gradient;
use crate::{d2psi_neo_hookean_dF2, dphi_linear_tetrahedron_dX, quadrature_single_point};

/// Hessian of an element's elastic energy, N/m; rows and columns 3i to 3i + 2 belong to vertex `element[i]`.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    quadrature_single_point(V, element, volume, |X| {
        let dphi = dphi_linear_tetrahedron_dX(V, element, X);
        let F = deformation_gradient(q, element, &dphi);
        let d2psi = d2psi_neo_hookean_dF2(&F, C, D);

        // ∂²ψ/∂q_ai∂q_bk = Σ_jl ∂φ_a/∂X_j (∂²ψ/∂F_ij∂F_kl) ∂φ_b/∂X_l: a 4×4 matrix over (a, b) for each (i, k).
        let mut H = SMatrix::<f64, 12, 12>::zeros();
        for i in 0..3 {
            for k in 0..3 {
                let over_vertices = dphi * d2psi.fixed_view::<3, 3>(3 * i, 3 * k) * dphi.transpose();
                for a in 0..4 {
                    for b in 0..4 {
                        H[(3 * a + i, 3 * b + k)] = over_vertices[(a, b)];
                    }
                }
            }
        }
        H
    })
}
