use nalgebra::{Matrix3, SVector};

/// First Piola–Kirchhoff stress ∂ψ/∂F, Pa, flattened row by row.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let (f0, f1, f2) = (F.column(0), F.column(1), F.column(2));
    let cof = Matrix3::from_columns(&[f1.cross(&f2), f2.cross(&f0), f0.cross(&f1)]); // ∂J/∂F
    let J = f0.dot(&cof.column(0));
    let I = F.norm_squared();

    let g = 1.0 / J.cbrt().powi(2); // J^(−2/3)
    let dg = -2.0 / 3.0 * g / J;
    let P = F * (2.0 * C * g) + cof * (C * I * dg + 2.0 * D * (J - 1.0));

    // nalgebra stores columns, so the transpose read in order is P read row by row.
    SVector::from_column_slice(P.transpose().as_slice())
}
