use nalgebra::{Matrix3, Matrix4x3, Vector3};

/// The rows of the inverse of the edges, and above them minus their sum.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], _X: &Vector3<f64>) -> Matrix4x3<f64> {
    let X = element.map(|vertex| V[vertex]);
    let edges = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]);
    let inverse = edges.try_inverse().unwrap();
    let first = -(inverse.row(0) + inverse.row(1) + inverse.row(2));
    Matrix4x3::from_rows(&[first, inverse.row(0).into(), inverse.row(1).into(), inverse.row(2).into()])
}
