use nalgebra::Vector3;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use crate::phi_linear_tetrahedron;

/// Weights of the display vertices by plain search through all elements.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    let mut weights = CooMatrix::new(V_skin.len(), V.len());
    for (i, x) in V_skin.iter().enumerate() {
        let mut chosen = None;
        let mut largest = f64::NEG_INFINITY;
        for element in T {
            let phi = phi_linear_tetrahedron(V, element, x);
            let smallest = phi.iter().copied().fold(f64::INFINITY, f64::min);
            if smallest > largest {
                largest = smallest;
                chosen = Some((element, phi));
            }
            if smallest >= -1e-6 {
                chosen = Some((element, phi));
                break;
            }
        }
        let (element, phi) = chosen.expect("a mesh with elements");
        for k in 0..4 {
            weights.push(i, element[k], phi[k]);
        }
    }
    CsrMatrix::from(&weights)
}
