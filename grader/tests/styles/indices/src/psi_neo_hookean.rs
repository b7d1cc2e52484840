use nalgebra::Matrix3;

/// The formula as it stands on the page.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.determinant();
    if J <= 0.0 {
        return f64::INFINITY;
    }
    let mut trace = 0.0;
    for i in 0..3 {
        for j in 0..3 {
            trace += F[(i, j)] * F[(i, j)];
        }
    }
    C * (trace / J.powf(2.0 / 3.0) - 3.0) + D * (J - 1.0) * (J - 1.0)
}
