use nalgebra::{Matrix3, SVector};

/// The chain rule, entry by entry.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let J = F.determinant();
    let mut trace = 0.0;
    for i in 0..3 {
        for j in 0..3 {
            trace += F[(i, j)] * F[(i, j)];
        }
    }
    let by_trace = C * J.powf(-2.0 / 3.0);
    let by_J = -2.0 / 3.0 * C * trace * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0);
    let mut result = SVector::zeros();
    for i in 0..3 {
        for j in 0..3 {
            let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            let cofactor = F[(i1, j1)] * F[(i2, j2)] - F[(i1, j2)] * F[(i2, j1)];
            result[3 * i + j] = by_trace * 2.0 * F[(i, j)] + by_J * cofactor;
        }
    }
    result
}
