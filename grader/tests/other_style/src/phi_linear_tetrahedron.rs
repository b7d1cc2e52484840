use nalgebra::{Matrix4, Vector3, Vector4};

/// Barycentric coordinates from one 4×4 system: the point comes back, and so does a constant.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    // Measured from the first vertex and in units of an edge, so that the row of ones is of the same size.
    let origin = V[element[0]];
    let size = (V[element[1]] - origin).norm();
    let column = |vertex: usize| ((V[vertex] - origin) / size).push(1.0);
    let system = Matrix4::from_columns(&element.map(column));
    let right = ((x - origin) / size).push(1.0);
    system.lu().solve(&right).expect("an element that is not flat")
}
