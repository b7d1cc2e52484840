use nalgebra::SMatrix;

/// One number for equal vertices, half of it for different ones.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    SMatrix::from_fn(|row, column| match (row % 3 == column % 3, row / 3 == column / 3) {
        (false, _) => 0.0,
        (true, true) => density * volume / 10.0,
        (true, false) => density * volume / 20.0,
    })
}
