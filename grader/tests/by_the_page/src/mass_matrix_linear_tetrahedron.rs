use nalgebra::SMatrix;

/// Blocks m_ij times the identity, by the formula for products of powers of shape functions.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    let same = density * 6.0 * volume * 2.0 / 120.0;
    let different = density * 6.0 * volume / 120.0;
    let mut M = SMatrix::zeros();
    for i in 0..4 {
        for j in 0..4 {
            for k in 0..3 {
                M[(3 * i + k, 3 * j + k)] = if i == j { same } else { different };
            }
        }
    }
    M
}
