use nalgebra::{DVector, Vector3};

/// The density of the energy, integrated with one point.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    let F =
        crate::given::deformation_gradient(q, element, &crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]));
    crate::quadrature_single_point(V, element, volume, |_| crate::psi_neo_hookean(&F, C, D))
}
