use nalgebra::{Matrix3, Matrix4, SMatrix};

/// Consistent mass matrix: one number for each pair of vertices, times the identity of space.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    let mass = density * volume;
    let of_pairs = Matrix4::from_element(mass / 20.0) + Matrix4::from_diagonal_element(mass / 20.0);
    of_pairs.kronecker(&Matrix3::identity())
}
