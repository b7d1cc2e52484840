use nalgebra::Matrix3;

/// The formula; infinite where J ≤ 0.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.determinant();
    if J <= 0.0 {
        return f64::INFINITY;
    }
    C * (J.powf(-2.0 / 3.0) * (F.transpose() * F).trace() - 3.0) + D * (J - 1.0).powi(2)
}
