use nalgebra::{DVector, Vector3};

use crate::given::deformation_gradient;
use crate::{dphi_linear_tetrahedron_dX, psi_neo_hookean, quadrature_single_point};

/// Elastic energy of one element, J.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    quadrature_single_point(V, element, volume, |X| {
        let dphi = dphi_linear_tetrahedron_dX(V, element, X);
        psi_neo_hookean(&deformation_gradient(q, element, &dphi), C, D)
    })
}
