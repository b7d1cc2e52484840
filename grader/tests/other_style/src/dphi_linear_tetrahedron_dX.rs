use nalgebra::{Matrix3, Matrix4x3, Vector3};

/// Gradients of the shape functions: the inverse of the matrix of edges, and what makes the columns add up to zero.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], _: &Vector3<f64>) -> Matrix4x3<f64> {
    let edges = Matrix3::from_fn(|row, column| V[element[column + 1]][row] - V[element[0]][row]);
    let inverse = edges.try_inverse().expect("an element that is not flat");
    Matrix4x3::from_fn(|vertex, axis| match vertex {
        0 => -(0..3).map(|row| inverse[(row, axis)]).sum::<f64>(),
        other => inverse[(other - 1, axis)],
    })
}
