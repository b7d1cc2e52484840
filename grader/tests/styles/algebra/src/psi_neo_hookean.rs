use nalgebra::Matrix3;

/// With the principal stretches; the determinant alone tells an element that is inside out.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    if F.determinant() <= 0.0 {
        return f64::INFINITY;
    }
    let stretches = F.singular_values();
    let J = stretches.product();
    let squares = stretches.component_mul(&stretches).sum();
    C * (squares * J.powf(-2.0 / 3.0) - 3.0) + D * (J - 1.0).powi(2)
}
