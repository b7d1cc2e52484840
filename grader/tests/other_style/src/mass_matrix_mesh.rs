use nalgebra_sparse::{CooMatrix, CsrMatrix};

use crate::mass_matrix_linear_tetrahedron;

/// Mass matrix of the mesh from triplets.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    let mut triplets = CooMatrix::new(q_size, q_size);
    for (element, &volume) in T.iter().zip(v0) {
        let of_element = mass_matrix_linear_tetrahedron(density, volume);
        let global = |local: usize| 3 * element[local / 3] + local % 3;
        for row in 0..12 {
            for column in (0..12).filter(|column| column % 3 == row % 3) {
                triplets.push(global(row), global(column), of_element[(row, column)]);
            }
        }
    }
    CsrMatrix::from(&triplets)
}
