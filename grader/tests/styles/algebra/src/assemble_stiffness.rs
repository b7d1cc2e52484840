use nalgebra::{DVector, SMatrix, Vector3};
use nalgebra_sparse::CsrMatrix;

/// Into the pattern that the course gives, block by block, with Jacobi's rotations for the eigenvalues.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    let mut K = crate::given::sparsity(q.len(), T);
    for (element, &volume) in T.iter().zip(v0) {
        let H = positive_part(crate::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            let block = -H.fixed_view::<3, 3>(3 * i, 3 * j).into_owned();
            crate::given::add_block(&mut K, element[i], element[j], &block);
        }
    }
    K
}

/// Rotates until the matrix is diagonal, and puts it together again without its negative entries.
fn positive_part(mut H: SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12> {
    let mut vectors = SMatrix::<f64, 12, 12>::identity();
    let size = H.norm();
    for _ in 0..40 {
        for (p, r) in (0..12).flat_map(|p| (p + 1..12).map(move |r| (p, r))) {
            if H[(p, r)].abs() <= 1e-18 * size {
                continue;
            }
            let angle = 0.5 * (2.0 * H[(p, r)]).atan2(H[(p, p)] - H[(r, r)]);
            let (sin, cos) = angle.sin_cos();
            for k in 0..12 {
                (H[(k, p)], H[(k, r)]) = turned(H[(k, p)], H[(k, r)], sin, cos);
                (vectors[(k, p)], vectors[(k, r)]) = turned(vectors[(k, p)], vectors[(k, r)], sin, cos);
            }
            for k in 0..12 {
                (H[(p, k)], H[(r, k)]) = turned(H[(p, k)], H[(r, k)], sin, cos);
            }
        }
    }
    let kept = SMatrix::from_diagonal(&H.diagonal().map(|value| if value > 0.0 { value } else { 0.0 }));
    vectors * kept * vectors.transpose()
}

fn turned(a: f64, b: f64, sin: f64, cos: f64) -> (f64, f64) {
    (cos * a + sin * b, cos * b - sin * a)
}
