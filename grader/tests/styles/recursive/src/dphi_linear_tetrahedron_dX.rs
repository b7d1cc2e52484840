use nalgebra::{Matrix4x3, Vector3};

/// A linear function's slope: what it gains between two points that lie far enough apart for round-off not to show.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64> {
    let apart = (V[element[1]] - V[element[0]]).norm();
    let _ = X;
    let middle = element.iter().map(|&vertex| V[vertex]).sum::<Vector3<f64>>() / 4.0;
    let slope = |axis: usize| {
        let mut step = Vector3::zeros();
        step[axis] = apart;
        let (ahead, behind) = (middle + step, middle - step);
        let gained =
            crate::phi_linear_tetrahedron(V, element, &ahead) - crate::phi_linear_tetrahedron(V, element, &behind);
        gained / (ahead[axis] - behind[axis])
    };
    Matrix4x3::from_columns(&[slope(0), slope(1), slope(2)])
}
