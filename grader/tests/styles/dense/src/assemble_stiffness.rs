use nalgebra::{DMatrix, DVector, SMatrix, Vector3};
use nalgebra_sparse::CsrMatrix;

/// Adds blocks to a full matrix, each projected with eigenvectors of its own.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    let mut K = DMatrix::<f64>::zeros(q.len(), q.len());
    for (element, &volume) in T.iter().zip(v0) {
        let own = projected(crate::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            let mut block = K.fixed_view_mut::<3, 3>(3 * element[i], 3 * element[j]);
            block -= own.fixed_view::<3, 3>(3 * i, 3 * j);
        }
    }
    CsrMatrix::from(&K)
}

fn projected(H: SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12> {
    let mut eigen = H.symmetric_eigen();
    eigen.eigenvalues.apply(|value| *value = value.max(0.0));
    eigen.recompose()
}
