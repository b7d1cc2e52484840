use nalgebra::{DMatrix, Vector3};
use nalgebra_sparse::CsrMatrix;

/// Fills a full matrix.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    let mut N = DMatrix::<f64>::zeros(V_skin.len(), V.len());
    for (row, x) in V_skin.iter().enumerate() {
        let weights: Vec<_> = T.iter().map(|element| crate::phi_linear_tetrahedron(V, element, x)).collect();
        let holds = weights.iter().position(|phi| phi.iter().all(|&weight| weight >= -1e-6));
        let best = (0..T.len()).max_by(|&a, &b| weights[a].min().partial_cmp(&weights[b].min()).expect("numbers"));
        if let Some(chosen) = holds.or(best) {
            for (&vertex, &weight) in T[chosen].iter().zip(weights[chosen].iter()) {
                N[(row, vertex)] = weight;
            }
        }
    }
    CsrMatrix::from(&N)
}
