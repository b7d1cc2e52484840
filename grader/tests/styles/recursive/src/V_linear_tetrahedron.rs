use nalgebra::{DVector, Matrix3, Vector3};

/// One term for each vertex but the first.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let at = |i: usize| Vector3::from_fn(|k, _| q[3 * element[i] + k]);
    let F = (1..4).fold(Matrix3::zeros(), |F, i| F + (at(i) - at(0)) * dphi.row(i));
    crate::quadrature_single_point(V, element, volume, move |_| crate::psi_neo_hookean(&F, C, D))
}
