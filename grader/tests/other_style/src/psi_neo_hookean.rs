use nalgebra::Matrix3;

/// The energy density as it stands in the book.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.row(0).cross(&F.row(1)).dot(&F.row(2));
    if J.is_nan() || J <= 0.0 {
        return f64::INFINITY;
    }
    let right_cauchy_green = F.transpose() * F;
    let shape = right_cauchy_green.trace() / J.powf(2.0 / 3.0) - 3.0;
    let volume = (J - 1.0) * (J - 1.0);
    C * shape + D * volume
}
