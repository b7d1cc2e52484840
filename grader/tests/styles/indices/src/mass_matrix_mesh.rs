use nalgebra_sparse::CsrMatrix;

/// Rows as lists that grow, then the three arrays of compressed rows.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); q_size];
    for e in 0..T.len() {
        let M = crate::mass_matrix_linear_tetrahedron(density, v0[e]);
        for i in 0..12 {
            for j in 0..12 {
                if M[(i, j)] != 0.0 {
                    add(&mut rows[3 * T[e][i / 3] + i % 3], 3 * T[e][j / 3] + j % 3, M[(i, j)]);
                }
            }
        }
    }
    compressed(rows, q_size)
}

fn add(row: &mut Vec<(usize, f64)>, column: usize, value: f64) {
    for entry in row.iter_mut() {
        if entry.0 == column {
            entry.1 += value;
            return;
        }
    }
    row.push((column, value));
}

fn compressed(mut rows: Vec<Vec<(usize, f64)>>, columns: usize) -> CsrMatrix<f64> {
    let (mut offsets, mut indices, mut values) = (vec![0], Vec::new(), Vec::new());
    for row in rows.iter_mut() {
        row.sort_by_key(|entry| entry.0);
        for (column, value) in row.iter() {
            indices.push(*column);
            values.push(*value);
        }
        offsets.push(indices.len());
    }
    CsrMatrix::try_from_csr_data(rows.len(), columns, offsets, indices, values).unwrap()
}
