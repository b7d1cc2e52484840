use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The identity without the three rows of each fixed vertex.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let mut free = Vec::new();
    for row in 0..q_size {
        if !indices.contains(&(row / 3)) {
            free.push(row);
        }
    }
    let mut P = CooMatrix::new(free.len(), q_size);
    for row in 0..free.len() {
        P.push(row, free[row], 1.0);
    }
    CsrMatrix::from(&P)
}
