use nalgebra::{Matrix4x3, Vector3};

/// Normals of the opposite faces, divided by the heights above them.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64> {
    let corners = element.map(|vertex| V[vertex]);
    let gradient = |i: usize| {
        let [a, b, c] = [1, 2, 3].map(|k| corners[(i + k) % 4]);
        let normal = (b - a).cross(&(c - a));
        (normal / normal.dot(&(corners[i] - a))).transpose()
    };
    let _ = X;
    Matrix4x3::from_rows(&[0, 1, 2, 3].map(gradient))
}
