use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The sum of the matrices of the two halves of the mesh.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    if T.len() > 64 {
        let middle = T.len() / 2;
        return crate::assemble_stiffness(q, V, &T[..middle], &v0[..middle], C, D)
            + crate::assemble_stiffness(q, V, &T[middle..], &v0[middle..], C, D);
    }
    let mut triplets = CooMatrix::new(q.len(), q.len());
    for (element, &volume) in T.iter().zip(v0) {
        let H = crate::given::project(&crate::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        for (i, j) in (0..144).map(|k| (k / 12, k % 12)) {
            triplets.push(3 * element[i / 3] + i % 3, 3 * element[j / 3] + j % 3, -H[(i, j)]);
        }
    }
    CsrMatrix::from(&triplets)
}
