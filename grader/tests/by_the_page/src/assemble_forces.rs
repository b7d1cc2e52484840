use nalgebra::{DVector, Vector3};

/// Subtracts each element's gradient at its vertices.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    let mut f = DVector::zeros(q.len());
    for e in 0..T.len() {
        let gradient = crate::dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D);
        for i in 0..4 {
            for k in 0..3 {
                f[3 * T[e][i] + k] -= gradient[3 * i + k];
            }
        }
    }
    f
}
