use nalgebra::{DVector, Vector3};

use crate::dV_linear_tetrahedron_dq;

/// Elastic force on every vertex, N: f = −∂V/∂q.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    assert_eq!(T.len(), v0.len(), "{} elements, but {} volumes", T.len(), v0.len());
    let mut f = DVector::zeros(q.len());
    for (element, &volume) in T.iter().zip(v0) {
        let gradient = dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
        for a in 0..4 {
            for i in 0..3 {
                f[3 * element[a] + i] -= gradient[3 * a + i];
            }
        }
    }
    f
}
