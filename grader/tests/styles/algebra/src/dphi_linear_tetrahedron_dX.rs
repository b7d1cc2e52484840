use nalgebra::{Matrix3, Matrix4x3, Vector3};

/// The pseudo-inverse of the edges, which is their inverse.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64> {
    let edges = Matrix3::from_columns(&[1, 2, 3].map(|i| V[element[i]] - V[element[0]]));
    let size = edges.norm();
    let inverse = (edges / size).pseudo_inverse(1e-14).expect("a tolerance above zero") / size;
    let first = -inverse.row_sum();
    let _ = X;
    Matrix4x3::from_rows(&[first, inverse.row(0).into(), inverse.row(1).into(), inverse.row(2).into()])
}
