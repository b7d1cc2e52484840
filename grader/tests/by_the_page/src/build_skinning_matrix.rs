use nalgebra::Vector3;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The first element that holds the vertex, or else the one whose smallest weight is largest.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    let mut N = CooMatrix::new(V_skin.len(), V.len());
    for row in 0..V_skin.len() {
        let mut chosen = 0;
        let mut largest = f64::NEG_INFINITY;
        for e in 0..T.len() {
            let smallest = crate::phi_linear_tetrahedron(V, &T[e], &V_skin[row]).min();
            if smallest >= -1e-6 {
                chosen = e;
                break;
            }
            if smallest > largest {
                largest = smallest;
                chosen = e;
            }
        }
        let weights = crate::phi_linear_tetrahedron(V, &T[chosen], &V_skin[row]);
        for i in 0..4 {
            N.push(row, T[chosen][i], weights[i]);
        }
    }
    CsrMatrix::from(&N)
}
