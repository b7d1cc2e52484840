use nalgebra::{DVector, Matrix3, SVector, Vector3};

/// Three gradients; the fourth one is minus their sum.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &Vector3::zeros());
    let mut F = Matrix3::zeros();
    for i in 1..4 {
        let moved = q.fixed_rows::<3>(3 * element[i]) - q.fixed_rows::<3>(3 * element[0]);
        F += moved * dphi.row(i);
    }
    let P = Matrix3::from_row_slice(crate::dpsi_neo_hookean_dF(&F, C, D).as_slice());
    let mut gradient = SVector::<f64, 12>::zeros();
    for i in 1..4 {
        let own = P * dphi.row(i).transpose() * volume;
        for k in 0..3 {
            gradient[3 * i + k] += own[k];
            gradient[k] -= own[k];
        }
    }
    gradient
}
