use nalgebra::{Matrix3, Matrix4, SMatrix};

/// A 4×4 matrix, each of whose entries becomes a block.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    let couplings = Matrix4::from_element(1.0) + Matrix4::identity();
    couplings.kronecker(&Matrix3::identity()) * (density * volume / 20.0)
}
