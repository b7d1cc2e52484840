use std::collections::BTreeSet;

use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// A set of the fixed vertices.
pub fn fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64> {
    let fixed: BTreeSet<_> = indices.iter().copied().collect();
    let mut P = CooMatrix::new(q_size - 3 * fixed.len(), q_size);
    let mut row = 0;
    for vertex in (0..q_size / 3).filter(|vertex| !fixed.contains(vertex)) {
        for axis in 0..3 {
            P.push(row, 3 * vertex + axis, 1.0);
            row += 1;
        }
    }
    CsrMatrix::from(&P)
}
