use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The sum of the matrices of the two halves of the mesh.
pub fn mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64> {
    if T.len() > 64 {
        let middle = T.len() / 2;
        return crate::mass_matrix_mesh(q_size, &T[..middle], density, &v0[..middle])
            + crate::mass_matrix_mesh(q_size, &T[middle..], density, &v0[middle..]);
    }
    let mut triplets = CooMatrix::new(q_size, q_size);
    for (element, &volume) in T.iter().zip(v0) {
        let M = crate::mass_matrix_linear_tetrahedron(density, volume);
        for (i, j, k) in (0..48).map(|n| (n / 12, n / 3 % 4, n % 3)) {
            triplets.push(3 * element[i] + k, 3 * element[j] + k, M[(3 * i + k, 3 * j + k)]);
        }
    }
    CsrMatrix::from(&triplets)
}
