use nalgebra::Vector3;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Two passes over the elements, the second one for points that none of them holds; zeros in all other columns.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    let mut triplets = CooMatrix::new(V_skin.len(), V.len());
    for (row, x) in V_skin.iter().enumerate() {
        let mut chosen = None;
        for element in T {
            let phi = crate::phi_linear_tetrahedron(V, element, x);
            if chosen.is_none() && phi.min() > -1e-6 {
                chosen = Some((element, phi));
            }
        }
        if chosen.is_none() {
            let mut least = f64::NEG_INFINITY;
            for element in T {
                let phi = crate::phi_linear_tetrahedron(V, element, x);
                if phi.min() > least {
                    least = phi.min();
                    chosen = Some((element, phi));
                }
            }
        }
        for column in 0..V.len() {
            triplets.push(row, column, 0.0);
        }
        if let Some((element, phi)) = chosen {
            for i in 0..4 {
                triplets.push(row, element[i], phi[i] / 2.0);
                triplets.push(row, element[i], phi[i] / 2.0);
            }
        }
    }
    CsrMatrix::from(&triplets)
}
