use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

use crate::{dphi_linear_tetrahedron_dX, dpsi_neo_hookean_dF};

/// Gradient of an element's energy through the matrix B that turns its positions into F, row by row.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    let dphi = dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let mut B = SMatrix::<f64, 9, 12>::zeros();
    for vertex in 0..4 {
        for axis in 0..3 {
            B.fixed_view_mut::<3, 1>(3 * axis, 3 * vertex + axis).copy_from(&dphi.row(vertex).transpose());
        }
    }
    let x = SVector::<f64, 12>::from_fn(|row, _| q[3 * element[row / 3] + row % 3] - q[3 * element[0] + row % 3]);
    let F = Matrix3::from_row_iterator((B * x).iter().copied());
    B.tr_mul(&dpsi_neo_hookean_dF(&F, C, D)) * volume
}
