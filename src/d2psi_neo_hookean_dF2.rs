use nalgebra::{Matrix3, SMatrix, SVector};

/// Derivative of the first Piola–Kirchhoff stress ∂²ψ/∂F², Pa; rows and columns flatten F row by row.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let (f0, f1, f2) = (F.column(0), F.column(1), F.column(2));
    let cof = Matrix3::from_columns(&[f1.cross(&f2), f2.cross(&f0), f0.cross(&f1)]); // ∂J/∂F
    let J = f0.dot(&cof.column(0));
    let I = F.norm_squared();

    let g = 1.0 / J.cbrt().powi(2); // J^(−2/3)
    let dg = -2.0 / 3.0 * g / J;
    let d2g = -5.0 / 3.0 * dg / J;
    let on_identity = 2.0 * C * g;
    let on_F_and_cof = 2.0 * C * dg;
    let on_cof_and_cof = C * I * d2g + 2.0 * D;
    let on_d2J = C * I * dg + 2.0 * D * (J - 1.0);

    let F_rows = SVector::<f64, 9>::from_column_slice(F.transpose().as_slice());
    let cof_rows = SVector::<f64, 9>::from_column_slice(cof.transpose().as_slice());
    let mixed = F_rows * cof_rows.transpose();
    let mut H = (mixed + mixed.transpose()) * on_F_and_cof + cof_rows * cof_rows.transpose() * on_cof_and_cof;

    for i in 0..3 {
        for j in 0..3 {
            let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            let row = 3 * i + j;
            H[(row, row)] += on_identity;
            // ∂²J/∂F_ij∂F_kl = ε_ikm ε_jln F_mn has four entries in each row.
            H[(row, 3 * i1 + j1)] += on_d2J * F[(i2, j2)];
            H[(row, 3 * i2 + j2)] += on_d2J * F[(i1, j1)];
            H[(row, 3 * i1 + j2)] -= on_d2J * F[(i2, j1)];
            H[(row, 3 * i2 + j1)] -= on_d2J * F[(i1, j2)];
        }
    }
    H
}
