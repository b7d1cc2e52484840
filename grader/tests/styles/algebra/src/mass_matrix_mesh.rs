use std::collections::BTreeMap;

use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Couplings of pairs of vertices first, in a map, then one entry for each axis.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    let mut couplings: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for (element, &volume) in T.iter().zip(v0) {
        let M = crate::mass_matrix_linear_tetrahedron(density, volume);
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            *couplings.entry((element[i], element[j])).or_default() += M[(3 * i, 3 * j)];
        }
    }
    let mut M = CooMatrix::new(q_size, q_size);
    for ((i, j), mass) in couplings {
        (0..3).for_each(|axis| M.push(3 * i + axis, 3 * j + axis, mass));
    }
    CsrMatrix::from(&M)
}
