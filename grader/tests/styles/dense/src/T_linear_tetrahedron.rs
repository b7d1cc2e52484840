use nalgebra::{DMatrix, DVector};

/// With the selection of the element's coordinates as a matrix.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let mut S = DMatrix::zeros(12, qdot.len());
    for local in 0..12 {
        S[(local, 3 * element[local / 3] + local % 3)] = 1.0;
    }
    let own = S * qdot;
    let M = crate::mass_matrix_linear_tetrahedron(density, volume);
    (own.transpose() * M * &own)[(0, 0)] / 2.0
}
