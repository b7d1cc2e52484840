use nalgebra::{DVector, Matrix3, SMatrix, Vector3};

use crate::{d2psi_neo_hookean_dF2, dphi_linear_tetrahedron_dX};

/// Hessian of an element's energy as the product of three matrices.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    let dphi = dphi_linear_tetrahedron_dX(V, element, &V[element[3]]);
    let mut F = Matrix3::zeros();
    for (a, &vertex) in element.iter().enumerate() {
        let x = q.fixed_rows::<3>(3 * vertex) - q.fixed_rows::<3>(3 * element[3]);
        F += x * dphi.row(a);
    }
    let B = SMatrix::<f64, 9, 12>::from_fn(|row, column| match row / 3 == column % 3 {
        true => dphi[(column / 3, row % 3)],
        false => 0.0,
    });
    volume * B.transpose() * d2psi_neo_hookean_dF2(&F, C, D) * B
}
