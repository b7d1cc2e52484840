use nalgebra_sparse::CsrMatrix;

use crate::given::{add_block, sparsity};
use crate::mass_matrix_linear_tetrahedron;

/// Mass matrix of the whole mesh, kg.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    assert_eq!(T.len(), v0.len(), "{} elements, but {} volumes", T.len(), v0.len());
    let mut M = sparsity(q_size, T);
    for (element, &volume) in T.iter().zip(v0) {
        let M_element = mass_matrix_linear_tetrahedron(density, volume);
        for a in 0..4 {
            for b in 0..4 {
                let block = M_element.fixed_view::<3, 3>(3 * a, 3 * b).into_owned();
                add_block(&mut M, element[a], element[b], &block);
            }
        }
    }
    M
}
