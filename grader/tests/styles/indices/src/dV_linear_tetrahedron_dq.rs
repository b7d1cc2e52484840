use nalgebra::{DVector, Matrix3, SVector, Vector3};

/// Stress times gradient for each coordinate.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let mut F = Matrix3::zeros();
    for a in 0..3 {
        for b in 0..3 {
            for i in 1..4 {
                F[(a, b)] += (q[3 * element[i] + a] - q[3 * element[0] + a]) * dphi[(i, b)];
            }
        }
    }
    let P = crate::dpsi_neo_hookean_dF(&F, C, D);
    let mut gradient = SVector::zeros();
    for i in 0..4 {
        for a in 0..3 {
            for b in 0..3 {
                gradient[3 * i + a] += volume * P[3 * a + b] * dphi[(i, b)];
            }
        }
    }
    gradient
}
