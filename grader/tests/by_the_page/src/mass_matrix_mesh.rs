use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Triplets of all 3×3 blocks, added up by the conversion.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    let mut M = CooMatrix::new(q_size, q_size);
    for e in 0..T.len() {
        let own = crate::mass_matrix_linear_tetrahedron(density, v0[e]);
        for i in 0..4 {
            for j in 0..4 {
                for k in 0..3 {
                    for l in 0..3 {
                        M.push(3 * T[e][i] + k, 3 * T[e][j] + l, own[(3 * i + k, 3 * j + l)]);
                    }
                }
            }
        }
    }
    CsrMatrix::from(&M)
}
