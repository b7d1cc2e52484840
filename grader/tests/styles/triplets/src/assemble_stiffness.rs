use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Triplets, the diagonal ones twice with half their value.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    let mut triplets = CooMatrix::new(q.len(), q.len());
    for (element, volume) in T.iter().zip(v0).rev() {
        let H = crate::given::project(&crate::d2V_linear_tetrahedron_dq2(q, V, element, *volume, C, D));
        for (i, j) in (0..144).map(|k| (k / 12, k % 12)) {
            let (row, column) = (3 * element[i / 3] + i % 3, 3 * element[j / 3] + j % 3);
            if row == column {
                triplets.push(row, column, -H[(i, j)] / 2.0);
                triplets.push(row, column, -H[(i, j)] / 2.0);
            } else {
                triplets.push(row, column, -H[(i, j)]);
            }
        }
    }
    CsrMatrix::from(&triplets)
}
