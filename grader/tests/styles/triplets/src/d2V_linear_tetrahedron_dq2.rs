use nalgebra::{DVector, Matrix3, SMatrix, Vector3};

/// Scatters the entries of the material's matrix.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &Vector3::zeros());
    let mut F = Matrix3::zeros();
    for i in 1..4 {
        let moved = q.fixed_rows::<3>(3 * element[i]) - q.fixed_rows::<3>(3 * element[0]);
        F += moved * dphi.row(i);
    }
    let material = crate::d2psi_neo_hookean_dF2(&F, C, D);
    let mut H = SMatrix::<f64, 12, 12>::zeros();
    for (row, column) in (0..81).map(|k| (k / 9, k % 9)) {
        let value = volume * material[(row, column)];
        for (i, j) in (0..16).map(|k| (k / 4, k % 4)) {
            H[(3 * i + row / 3, 3 * j + column / 3)] += value * dphi[(i, row % 3)] * dphi[(j, column % 3)];
        }
    }
    H
}
