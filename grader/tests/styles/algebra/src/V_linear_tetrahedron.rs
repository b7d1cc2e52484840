use nalgebra::{DVector, SMatrix, Vector3};

/// With positions relative to their mean.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let mut positions = SMatrix::<f64, 3, 4>::from_fn(|axis, i| q[3 * element[i] + axis]);
    let mean = positions.column_mean();
    positions.column_iter_mut().for_each(|mut position| position -= mean);
    crate::quadrature_single_point(V, element, volume, |_| crate::psi_neo_hookean(&(positions * dphi), C, D))
}
