use nalgebra::{DVector, SMatrix, Vector3};

/// Blocks of 3×3, each a contraction of the material's matrix with two gradients.
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
    let material = crate::d2psi_neo_hookean_dF2(&F, C, D) * volume;
    let entry = |row: usize, column: usize| -> f64 {
        let block = material.fixed_view::<3, 3>(row % 3 * 3, column % 3 * 3);
        (dphi.row(row / 3) * block * dphi.row(column / 3).transpose()).sum()
    };
    SMatrix::from_fn(entry)
}
