use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

/// Bᵀ H B.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let first = q.fixed_rows::<3>(3 * element[0]).into_owned();
    let B = SMatrix::<f64, 9, 12>::from_fn(
        |row, column| {
            if row / 3 == column % 3 { dphi[(column / 3, row % 3)] } else { 0.0 }
        },
    );
    let own = SVector::<f64, 12>::from_fn(|local, _| q[3 * element[local / 3] + local % 3] - first[local % 3]);
    let F = Matrix3::from_row_slice((B * own).as_slice());
    B.transpose() * crate::d2psi_neo_hookean_dF2(&F, C, D) * B * volume
}
