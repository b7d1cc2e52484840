use nalgebra::{DVector, Matrix3, Vector3};

/// Volume times density of the energy.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let mut F = Matrix3::zeros();
    for a in 0..3 {
        for b in 0..3 {
            for i in 1..4 {
                F[(a, b)] += (q[3 * element[i] + a] - q[3 * element[0] + a]) * dphi[(i, b)];
            }
        }
    }
    volume * crate::psi_neo_hookean(&F, C, D)
}
