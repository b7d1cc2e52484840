use nalgebra::{DVector, Matrix3, SMatrix, Vector3};

/// Each entry as a sum over two derivatives of F.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let at = |i: usize| Vector3::from_fn(|k, _| q[3 * element[i] + k]);
    let F = (1..4).fold(Matrix3::zeros(), |F, i| F + (at(i) - at(0)) * dphi.row(i));
    let H = crate::d2psi_neo_hookean_dF2(&F, C, D);
    let entry = |row: usize, column: usize| {
        let (a, b) = (3 * (row % 3), 3 * (column % 3));
        let pairs = (0..9).map(|k| (k / 3, k % 3));
        volume * pairs.map(|(c, d)| dphi[(row / 3, c)] * H[(a + c, b + d)] * dphi[(column / 3, d)]).sum::<f64>()
    };
    SMatrix::from_fn(entry)
}
