use nalgebra::{DVector, Matrix3, SMatrix, Vector3};

/// Six nested loops.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let mut F = Matrix3::zeros();
    for a in 0..3 {
        for b in 0..3 {
            for i in 1..4 {
                F[(a, b)] += (q[3 * element[i] + a] - q[3 * element[0] + a]) * dphi[(i, b)];
            }
        }
    }
    let material = crate::d2psi_neo_hookean_dF2(&F, C, D);
    let mut H = SMatrix::zeros();
    for i in 0..4 {
        for a in 0..3 {
            for j in 0..4 {
                for b in 0..3 {
                    let mut sum = 0.0;
                    for c in 0..3 {
                        for d in 0..3 {
                            sum += dphi[(i, c)] * material[(3 * a + c, 3 * b + d)] * dphi[(j, d)];
                        }
                    }
                    H[(3 * i + a, 3 * j + b)] = volume * sum;
                }
            }
        }
    }
    H
}
