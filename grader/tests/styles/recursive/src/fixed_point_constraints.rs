use nalgebra_sparse::CsrMatrix;

/// One vertex after the other, from a sorted list.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    fn free(vertex: usize, vertices: usize, fixed: &[usize], rows: &mut Vec<usize>) {
        if vertex == vertices {
            return;
        }
        if fixed.binary_search(&vertex).is_err() {
            rows.extend([3 * vertex, 3 * vertex + 1, 3 * vertex + 2]);
        }
        free(vertex + 1, vertices, fixed, rows);
    }
    let mut fixed = indices.to_vec();
    fixed.sort_unstable();
    let mut columns = Vec::new();
    free(0, q_size / 3, &fixed, &mut columns);
    let P = CsrMatrix::try_from_csr_data(
        columns.len(),
        q_size,
        (0..=columns.len()).collect(),
        columns.clone(),
        vec![1.0; columns.len()],
    );
    P.expect("one entry in each row")
}
