use nalgebra::SMatrix;

/// Four points of integration, each a sum of products.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    let (near, far) = ((5.0 + 3.0 * 5f64.sqrt()) / 20.0, (5.0 - 5f64.sqrt()) / 20.0);
    let phi = |point: usize, i: usize| if point == i { near } else { far };
    let mut M = SMatrix::zeros();
    for (point, i, j) in (0..64).map(|k| (k / 16, k / 4 % 4, k % 4)) {
        for k in 0..3 {
            M[(3 * i + k, 3 * j + k)] += density * volume / 4.0 * phi(point, i) * phi(point, j);
        }
    }
    M
}
