use nalgebra::SMatrix;

/// Consistent mass matrix of one element, kg.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    // ∫ φ_a φ_b = volume (1 + δ_ab) / 20, the same for x, y and z, which do not mix.
    let twentieth = density * volume / 20.0;
    SMatrix::<f64, 12, 12>::from_fn(|row, column| match (row == column, row % 3 == column % 3) {
        (true, _) => 2.0 * twentieth,
        (false, true) => twentieth,
        (false, false) => 0.0,
    })
}
