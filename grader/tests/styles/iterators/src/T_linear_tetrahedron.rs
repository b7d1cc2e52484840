use nalgebra::{DVector, SVector};

/// The quadratic form of the element's mass matrix.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let own =
        SVector::<f64, 12>::from_iterator(element.iter().flat_map(|&vertex| (0..3).map(move |k| qdot[3 * vertex + k])));
    0.5 * (crate::mass_matrix_linear_tetrahedron(density, volume) * own).dot(&own)
}
