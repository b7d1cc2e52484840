use nalgebra::{DVector, Vector3};
use nalgebra_sparse::CsrMatrix;

use crate::d2V_linear_tetrahedron_dq2;
use crate::given::{add_block, project, sparsity};

/// Stiffness of the whole mesh, N/m: K = −Σ project(∂²V/∂q²), so negative semi-definite.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    assert_eq!(T.len(), v0.len(), "{} elements, but {} volumes", T.len(), v0.len());
    let mut K = sparsity(q.len(), T);
    for (element, &volume) in T.iter().zip(v0) {
        let H = project(&d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        for a in 0..4 {
            for b in 0..4 {
                let block = -H.fixed_view::<3, 3>(3 * a, 3 * b);
                add_block(&mut K, element[a], element[b], &block);
            }
        }
    }
    K
}
