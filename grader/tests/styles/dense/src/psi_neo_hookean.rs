use nalgebra::Matrix3;

/// With the matrix FᵀF.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let (J, stretch) = (F.determinant(), F.transpose() * F);
    if J > 0.0 { C * (J.powf(-2.0 / 3.0) * stretch.trace() - 3.0) + D * (J - 1.0) * (J - 1.0) } else { f64::INFINITY }
}
