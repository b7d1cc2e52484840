use nalgebra::{Matrix3, SVector};

/// The derivative by each entry, in terms of the minor that belongs to it.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let J = F.determinant();
    let derivative = |k: usize| {
        let (i, j) = (k / 3, k % 3);
        let sign = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
        let cofactor = sign * F.remove_row(i).remove_column(j).determinant();
        let dI = 2.0 * F[(i, j)];
        C * (dI / J.powf(2.0 / 3.0) - 2.0 / 3.0 * F.norm_squared() * cofactor / J.powf(5.0 / 3.0))
            + D * 2.0 * (J - 1.0) * cofactor
    };
    SVector::from_fn(|k, _| derivative(k))
}
