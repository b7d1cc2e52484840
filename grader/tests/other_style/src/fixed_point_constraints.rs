use std::collections::BTreeSet;

use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The matrix that leaves out the coordinates of fixed vertices.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let fixed: BTreeSet<usize> = indices.iter().copied().collect();
    let free: Vec<usize> = (0..q_size / 3).filter(|vertex| !fixed.contains(vertex)).collect();
    let mut ones = CooMatrix::new(q_size - 3 * fixed.len(), q_size);
    for (row, vertex) in free.into_iter().enumerate() {
        for axis in 0..3 {
            ones.push(3 * row + axis, 3 * vertex + axis, 1.0);
        }
    }
    CsrMatrix::from(&ones)
}
