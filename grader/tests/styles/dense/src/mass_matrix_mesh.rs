use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;

/// Adds blocks to a full matrix.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    let mut M = DMatrix::<f64>::zeros(q_size, q_size);
    for (element, &volume) in T.iter().zip(v0) {
        let own = crate::mass_matrix_linear_tetrahedron(density, volume);
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            let mut block = M.fixed_view_mut::<3, 3>(3 * element[i], 3 * element[j]);
            block += own.fixed_view::<3, 3>(3 * i, 3 * j);
        }
    }
    CsrMatrix::from(&M)
}
