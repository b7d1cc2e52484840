use nalgebra::{Matrix3, Vector3, Vector4};

/// The 3×3 system for φ1, φ2 and φ3; the sum gives φ0.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let X = element.map(|vertex| V[vertex]);
    let edges = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]);
    let phi = edges.lu().solve(&(x - X[0])).unwrap();
    Vector4::new(1.0 - phi.sum(), phi[0], phi[1], phi[2])
}
