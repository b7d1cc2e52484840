use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// A one for each coordinate whose vertex is not in the list.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let free: Vec<usize> = (0..q_size).filter(|coordinate| !indices.contains(&(coordinate / 3))).collect();
    let mut P = CooMatrix::new(free.len(), q_size);
    free.iter().enumerate().for_each(|(row, &column)| P.push(row, column, 1.0));
    CsrMatrix::from(&P)
}
