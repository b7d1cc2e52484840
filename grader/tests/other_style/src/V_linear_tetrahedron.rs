use nalgebra::{DVector, Matrix3, Vector3};

use crate::psi_neo_hookean;

/// Elastic energy of one element through F = Ds Dm⁻¹.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    let [a, b, c, d] = *element;
    let x = |vertex: usize| q.fixed_rows::<3>(3 * vertex).into_owned();
    let deformed = Matrix3::from_columns(&[x(b) - x(a), x(c) - x(a), x(d) - x(a)]);
    let undeformed = Matrix3::from_columns(&[V[b] - V[a], V[c] - V[a], V[d] - V[a]]);
    let F = deformed * undeformed.try_inverse().expect("an element that is not flat");
    volume * psi_neo_hookean(&F, C, D)
}
