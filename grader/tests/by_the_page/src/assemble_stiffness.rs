use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Projects, takes the minus, and adds sixteen 3×3 blocks for each element.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    let mut K = CooMatrix::new(q.len(), q.len());
    for e in 0..T.len() {
        let exact = crate::d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D);
        let own = -crate::given::project(&exact);
        for i in 0..4 {
            for j in 0..4 {
                for k in 0..3 {
                    for l in 0..3 {
                        K.push(3 * T[e][i] + k, 3 * T[e][j] + l, own[(3 * i + k, 3 * j + l)]);
                    }
                }
            }
        }
    }
    CsrMatrix::from(&K)
}
