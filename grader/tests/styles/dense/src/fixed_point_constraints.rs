use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;

/// Rows of the identity.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let free: Vec<usize> = (0..q_size).filter(|row| !indices.contains(&(row / 3))).collect();
    CsrMatrix::from(&DMatrix::from_fn(free.len(), q_size, |row, column| f64::from(u8::from(free[row] == column))))
}
