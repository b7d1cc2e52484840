use nalgebra::{DVector, SVector};

use crate::mass_matrix_linear_tetrahedron;

/// Kinetic energy of one element, J.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let v = SVector::<f64, 12>::from_fn(|row, _| qdot[3 * element[row / 3] + row % 3]);
    0.5 * v.dot(&(mass_matrix_linear_tetrahedron(density, volume) * v))
}
