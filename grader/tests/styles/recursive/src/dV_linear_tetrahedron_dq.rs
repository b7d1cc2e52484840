use nalgebra::{DVector, Matrix3, SVector, Vector3};

/// Each entry of the stress with the derivative of its entry of F.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let at = |i: usize| Vector3::from_fn(|k, _| q[3 * element[i] + k]);
    let F = (1..4).fold(Matrix3::zeros(), |F, i| F + (at(i) - at(0)) * dphi.row(i));
    let P = crate::dpsi_neo_hookean_dF(&F, C, D);
    SVector::from_fn(|local, _| (0..3).map(|b| P[3 * (local % 3) + b] * dphi[(local / 3, b)]).sum::<f64>() * volume)
}
