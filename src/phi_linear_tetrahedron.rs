use nalgebra::{Vector3, Vector4};

/// Values of the four linear shape functions at a point, dimensionless.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let [X0, X1, X2, X3] = element.map(|vertex| V[vertex]);
    let (e1, e2, e3, r) = (X1 - X0, X2 - X0, X3 - X0, x - X0);

    // Cramer's rule for r = φ1 e1 + φ2 e2 + φ3 e3: each φ is a ratio of two volumes.
    let six_volumes = e1.dot(&e2.cross(&e3));
    let phi1 = r.dot(&e2.cross(&e3)) / six_volumes;
    let phi2 = r.dot(&e3.cross(&e1)) / six_volumes;
    let phi3 = r.dot(&e1.cross(&e2)) / six_volumes;

    Vector4::new(1.0 - phi1 - phi2 - phi3, phi1, phi2, phi3)
}
