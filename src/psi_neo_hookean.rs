use nalgebra::Matrix3;

/// Neo-Hookean strain energy density C (J^(−2/3) tr(FᵀF) − 3) + D (J − 1)², J/m³; +∞ where J = det F ≤ 0.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.determinant();
    if J <= 0.0 {
        return f64::INFINITY;
    }

    // Near rest J^(−2/3) I − 3 is a small difference of large numbers, so I − 3 and J − 1 are computed from E = F − 1.
    // Far from rest this gains no digits, and loses some under strong compression.
    let E = F - Matrix3::identity();
    if E.norm() > 0.5 {
        return C * (J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2);
    }
    let I_minus_3 = 2.0 * E.trace() + E.norm_squared();
    let J_minus_1 = determinant_minus_1(&E);
    let g_minus_1 = (-2.0 / 3.0 * J_minus_1.ln_1p()).exp_m1();
    C * ((1.0 + g_minus_1) * I_minus_3 + 3.0 * g_minus_1) + D * J_minus_1 * J_minus_1
}

/// det(1 + E) − 1 = tr E + the sum of the principal 2×2 minors of E + det E.
fn determinant_minus_1(E: &Matrix3<f64>) -> f64 {
    let minor = |i, j| E[(i, i)] * E[(j, j)] - E[(i, j)] * E[(j, i)];
    E.trace() + minor(0, 1) + minor(1, 2) + minor(2, 0) + E.determinant()
}
