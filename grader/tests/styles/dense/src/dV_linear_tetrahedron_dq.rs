use nalgebra::{DVector, Matrix3, Matrix4x3, SMatrix, SVector, Vector3};

/// With the matrix B.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    let B = flattening(&crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]));
    let first = q.fixed_rows::<3>(3 * element[0]).into_owned();
    let own = SVector::<f64, 12>::from_fn(|local, _| q[3 * element[local / 3] + local % 3] - first[local % 3]);
    let f = B * own;
    B.transpose() * crate::dpsi_neo_hookean_dF(&Matrix3::from_row_slice(f.as_slice()), C, D) * volume
}

/// F, row by row, as a linear function of the twelve coordinates.
fn flattening(dphi: &Matrix4x3<f64>) -> SMatrix<f64, 9, 12> {
    SMatrix::from_fn(|row, column| if row / 3 == column % 3 { dphi[(column / 3, row % 3)] } else { 0.0 })
}
