use nalgebra::{Matrix3, SVector};

/// The chain rule with its two terms; J and its derivative from the rows of F.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let f0 = F.row(0).transpose();
    let f1 = F.row(1).transpose();
    let f2 = F.row(2).transpose();
    let J = f0.dot(&f1.cross(&f2));
    let I = (F.transpose() * F).trace();
    let psi_I = C * J.powf(-2.0 / 3.0);
    let psi_J = -2.0 / 3.0 * C * J.powf(-5.0 / 3.0) * I + 2.0 * D * (J - 1.0);
    let cofactors = [f1.cross(&f2), f2.cross(&f0), f0.cross(&f1)];
    let mut P = SVector::zeros();
    for i in 0..3 {
        for j in 0..3 {
            P[3 * i + j] = psi_I * 2.0 * F[(i, j)] + psi_J * cofactors[i][j];
        }
    }
    P
}
