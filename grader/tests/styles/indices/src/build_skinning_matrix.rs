use nalgebra::Vector3;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The first element that holds a point, or else the one that it misses by least.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    let mut triplets = CooMatrix::new(V_skin.len(), V.len());
    for s in 0..V_skin.len() {
        let mut chosen = usize::MAX;
        let mut chosen_least = f64::NEG_INFINITY;
        let mut chosen_phi = [0.0; 4];
        for e in 0..T.len() {
            let phi = crate::phi_linear_tetrahedron(V, &T[e], &V_skin[s]);
            let mut least = phi[0];
            for i in 1..4 {
                if phi[i] < least {
                    least = phi[i];
                }
            }
            if least > chosen_least {
                chosen = e;
                chosen_least = least;
                chosen_phi = [phi[0], phi[1], phi[2], phi[3]];
            }
            if least >= -1e-6 {
                chosen = e;
                chosen_phi = [phi[0], phi[1], phi[2], phi[3]];
                break;
            }
        }
        if chosen != usize::MAX {
            for i in 0..4 {
                triplets.push(s, T[chosen][i], chosen_phi[i]);
            }
        }
    }
    CsrMatrix::from(&triplets)
}
