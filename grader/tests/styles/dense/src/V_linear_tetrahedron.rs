use nalgebra::{DVector, Matrix3, Vector3};

/// Edges to edges.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    let at = |vertex: usize| q.fixed_rows::<3>(3 * vertex).into_owned();
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    let [x, y, z, w] = element.map(at);
    let before = Matrix3::from_columns(&[b - a, c - a, d - a]);
    let after = Matrix3::from_columns(&[y - x, z - x, w - x]);
    let F = after * before.try_inverse().expect("an element with volume");
    volume * crate::psi_neo_hookean(&F, C, D)
}
