use nalgebra::Matrix3;

/// Both terms, or infinity.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    Some(F.determinant())
        .filter(|J| *J > 0.0)
        .map(|J| {
            let squares: f64 = F.iter().map(|entry| entry * entry).sum();
            C * (squares / J.cbrt().powi(2) - 3.0) + D * (J - 1.0).powi(2)
        })
        .unwrap_or(f64::INFINITY)
}
