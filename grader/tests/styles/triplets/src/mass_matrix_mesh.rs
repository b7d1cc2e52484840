use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Triplets in two halves, zeros among them.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    let mut triplets = CooMatrix::new(q_size, q_size);
    for half in [0.25, 0.75] {
        for (element, volume) in T.iter().zip(v0) {
            let M = crate::mass_matrix_linear_tetrahedron(density, volume * half);
            for (i, j) in (0..144).map(|k| (k / 12, k % 12)) {
                triplets.push(3 * element[i / 3] + i % 3, 3 * element[j / 3] + j % 3, M[(i, j)]);
            }
        }
    }
    for i in 0..q_size {
        triplets.push(i, i, 0.0);
    }
    CsrMatrix::from(&triplets)
}
