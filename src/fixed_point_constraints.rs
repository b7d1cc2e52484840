use nalgebra_sparse::CsrMatrix;

/// Selection matrix P that leaves out the coordinates of fixed vertices, dimensionless.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let mut is_fixed = vec![false; q_size / 3];
    for &vertex in indices {
        assert!(vertex < is_fixed.len(), "fixed vertex {vertex}, but only {} vertices", is_fixed.len());
        is_fixed[vertex] = true;
    }

    let kept: Vec<usize> = (0..q_size).filter(|coordinate| !is_fixed[coordinate / 3]).collect();
    let rows = kept.len();
    CsrMatrix::try_from_csr_data(rows, q_size, (0..=rows).collect(), kept, vec![1.0; rows])
        .expect("one entry in each row")
}
