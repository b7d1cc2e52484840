use nalgebra::{DVector, SMatrix, Vector3};

/// v₀ Bᵀ ∂²ψ/∂f² B.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let F = crate::given::deformation_gradient(q, element, &dphi);
    let mut B = SMatrix::<f64, 9, 12>::zeros();
    for i in 0..4 {
        for a in 0..3 {
            for b in 0..3 {
                B[(3 * a + b, 3 * i + a)] = dphi[(i, b)];
            }
        }
    }
    B.transpose() * crate::d2psi_neo_hookean_dF2(&F, C, D) * B * volume
}
