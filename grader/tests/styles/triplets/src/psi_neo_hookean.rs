use nalgebra::Matrix3;

/// With the isochoric part of F.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.column(0).dot(&F.column(1).cross(&F.column(2)));
    match J {
        J if J > 0.0 => {
            let same_volume = F / J.cbrt();
            C * (same_volume.norm_squared() - 3.0) + D * (J - 1.0).powi(2)
        }
        _ => f64::INFINITY,
    }
}
