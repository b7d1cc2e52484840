use nalgebra::{Matrix3, Vector3, Vector4};

/// By a QR factorisation of the edges.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let edges = Matrix3::from_columns(&[1, 2, 3].map(|i| V[element[i]] - V[element[0]]));
    let others = edges.qr().solve(&(x - V[element[0]])).expect("an element with volume");
    Vector4::new(1.0 - others.sum(), others.x, others.y, others.z)
}
