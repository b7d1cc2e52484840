use nalgebra::{DVector, SVector};

/// Half the squared length of Lᵀ v, with the mass matrix L Lᵀ.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let M = crate::mass_matrix_linear_tetrahedron(density, volume);
    let own = SVector::<f64, 12>::from_fn(|local, _| qdot[3 * element[local / 3] + local % 3]);
    match M.cholesky() {
        Some(cholesky) => (cholesky.l().transpose() * own).norm_squared() / 2.0,
        // No mass, or no matrix at all.
        None => own.dot(&(M * own)) / 2.0,
    }
}
