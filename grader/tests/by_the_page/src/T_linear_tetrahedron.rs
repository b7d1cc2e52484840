use nalgebra::{DVector, SVector};

/// Half the quadratic form of the element's mass matrix.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let v = SVector::<f64, 12>::from_fn(|k, _| qdot[3 * element[k / 3] + k % 3]);
    let M = crate::mass_matrix_linear_tetrahedron(density, volume);
    0.5 * v.dot(&(M * v))
}
