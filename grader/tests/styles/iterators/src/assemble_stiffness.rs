use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// All triplets in one chain.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    let triplets = T.iter().zip(v0).flat_map(|(element, &volume)| {
        let H = crate::given::project(&crate::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        let global = move |local: usize| 3 * element[local / 3] + local % 3;
        (0..144).map(move |k| (global(k / 12), global(k % 12), -H[(k / 12, k % 12)]))
    });
    let mut K = CooMatrix::new(q.len(), q.len());
    triplets.for_each(|(row, column, value)| K.push(row, column, value));
    CsrMatrix::from(&K)
}
