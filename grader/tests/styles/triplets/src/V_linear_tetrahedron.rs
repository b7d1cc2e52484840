use nalgebra::{DVector, Matrix3, Vector3};

/// With differences of positions.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &Vector3::zeros());
    let mut F = Matrix3::zeros();
    for i in 1..4 {
        let moved = q.fixed_rows::<3>(3 * element[i]) - q.fixed_rows::<3>(3 * element[0]);
        F += moved * dphi.row(i);
    }
    crate::psi_neo_hookean(&F, C, D) * volume
}
