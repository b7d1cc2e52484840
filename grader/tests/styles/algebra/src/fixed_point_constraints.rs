use nalgebra_sparse::CsrMatrix;

/// The identity without the rows that are filtered out.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let identity = CsrMatrix::<f64>::identity(q_size);
    let (mut offsets, mut columns) = (vec![0], Vec::new());
    for row in identity.row_iter() {
        let column = row.col_indices()[0];
        if !indices.iter().any(|vertex| *vertex == column / 3) {
            columns.push(column);
            offsets.push(columns.len());
        }
    }
    let ones = vec![1.0; columns.len()];
    CsrMatrix::try_from_csr_data(columns.len(), q_size, offsets, columns, ones).expect("a pattern")
}
