use nalgebra::{Matrix3, Matrix4x3, Vector3};

/// Solves for one row after the other: along the edges the gradient gains one or nothing.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64> {
    let origin = V[element[0]];
    let edges = Matrix3::from_rows(&[1, 2, 3].map(|i| (V[element[i]] - origin).transpose()));
    let edges = edges.lu();
    let mut dphi = Matrix4x3::zeros();
    for i in 0..4 {
        // φ at the other end of each edge, minus φ at vertex 0.
        let gains = Vector3::from_fn(|edge, _| f64::from(u8::from(edge + 1 == i)) - f64::from(u8::from(i == 0)));
        let gradient = edges.solve(&gains).expect("an element with volume");
        dphi.set_row(i, &gradient.transpose());
    }
    let _ = X;
    dphi
}
