use nalgebra::{DVector, Matrix3, SVector, Vector3};

/// Stress times gradient for each vertex.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let F = crate::given::deformation_gradient(q, element, &dphi);
    let P = Matrix3::from_row_iterator(crate::dpsi_neo_hookean_dF(&F, C, D).iter().copied());
    SVector::from_iterator(dphi.row_iter().flat_map(|gradient| {
        let force = P * gradient.transpose() * volume;
        [force.x, force.y, force.z]
    }))
}
