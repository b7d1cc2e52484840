use nalgebra_sparse::CsrMatrix;

/// One flag for each vertex.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let n = q_size / 3;
    let mut fixed = vec![false; n];
    for k in 0..indices.len() {
        fixed[indices[k]] = true;
    }
    let (mut offsets, mut columns, mut ones) = (vec![0], Vec::new(), Vec::new());
    for vertex in 0..n {
        if !fixed[vertex] {
            for axis in 0..3 {
                columns.push(3 * vertex + axis);
                ones.push(1.0);
                offsets.push(columns.len());
            }
        }
    }
    CsrMatrix::try_from_csr_data(columns.len(), q_size, offsets, columns, ones).unwrap()
}
