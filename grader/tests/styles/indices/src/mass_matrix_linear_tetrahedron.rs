use nalgebra::SMatrix;

/// Tenths on the diagonal, twentieths beside it.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    let mut M = SMatrix::zeros();
    for i in 0..4 {
        for j in 0..4 {
            for k in 0..3 {
                M[(3 * i + k, 3 * j + k)] = density * volume * if i == j { 0.1 } else { 0.05 };
            }
        }
    }
    M
}
