use nalgebra::{Matrix3, Matrix4x3, Vector3};

/// The inverse of the edges below the sum that makes the columns zero.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64> {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    let _ = X;
    let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
    let sums = Matrix4x3::new(-1.0, -1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    sums * edges.try_inverse().expect("an element with volume")
}
