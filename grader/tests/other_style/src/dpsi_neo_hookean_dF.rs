use nalgebra::{Matrix3, SVector};

/// First Piola-Kirchhoff stress through the inverse transpose of F.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let J = F.determinant();
    let inverse_transpose = F.try_inverse().expect("an invertible F").transpose();
    let squares: f64 = F.iter().map(|entry| entry * entry).sum();
    let deviator = F - inverse_transpose * (squares / 3.0);
    let P = deviator * (2.0 * C * J.powf(-2.0 / 3.0)) + inverse_transpose * (2.0 * D * (J - 1.0) * J);
    SVector::from_iterator((0..9).map(|entry| P[(entry / 3, entry % 3)]))
}
