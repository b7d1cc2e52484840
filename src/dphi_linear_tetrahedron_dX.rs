use nalgebra::{Matrix4x3, Vector3};

/// Gradients of the four linear shape functions, 1/m; row `i` belongs to vertex `element[i]`.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], _X: &Vector3<f64>) -> Matrix4x3<f64> {
    let [X0, X1, X2, X3] = element.map(|vertex| V[vertex]);
    let (e1, e2, e3) = (X1 - X0, X2 - X0, X3 - X0);

    // A gradient is normal to the face on which its shape function vanishes, and one over the height above it long.
    let six_volumes = e1.dot(&e2.cross(&e3));
    let g1 = e2.cross(&e3) / six_volumes;
    let g2 = e3.cross(&e1) / six_volumes;
    let g3 = e1.cross(&e2) / six_volumes;
    let g0 = -(g1 + g2 + g3);

    Matrix4x3::from_rows(&[g0.transpose(), g1.transpose(), g2.transpose(), g3.transpose()])
}
