use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// All triplets in one chain.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    let triplets = T.iter().zip(v0).flat_map(|(element, &volume)| {
        let M = crate::mass_matrix_linear_tetrahedron(density, volume);
        let global = move |local: usize| 3 * element[local / 3] + local % 3;
        (0..144).map(move |k| (global(k / 12), global(k % 12), M[(k / 12, k % 12)]))
    });
    let mut M = CooMatrix::new(q_size, q_size);
    triplets.for_each(|(row, column, value)| M.push(row, column, value));
    CsrMatrix::from(&M)
}
