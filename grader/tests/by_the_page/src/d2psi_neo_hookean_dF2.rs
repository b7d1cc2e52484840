use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// The five factors, and the matrix of cross products with the rows of F.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let rows = [F.row(0).transpose(), F.row(1).transpose(), F.row(2).transpose()];
    let cofactors = [rows[1].cross(&rows[2]), rows[2].cross(&rows[0]), rows[0].cross(&rows[1])];
    let f = SVector::<f64, 9>::from_fn(|k, _| rows[k / 3][k % 3]);
    let c = SVector::<f64, 9>::from_fn(|k, _| cofactors[k / 3][k % 3]);
    let J = F.determinant();
    let I = (F.transpose() * F).trace();
    let psi_I = C * J.powf(-2.0 / 3.0);
    let psi_J = -2.0 / 3.0 * C * J.powf(-5.0 / 3.0) * I + 2.0 * D * (J - 1.0);
    let psi_IJ = -2.0 / 3.0 * C * J.powf(-5.0 / 3.0);
    let psi_JJ = 10.0 / 9.0 * C * J.powf(-8.0 / 3.0) * I + 2.0 * D;

    let mut second = SMatrix::<f64, 9, 9>::zeros();
    for (i, j, block) in [
        (0, 1, -hat(&rows[2])),
        (0, 2, hat(&rows[1])),
        (1, 0, hat(&rows[2])),
        (1, 2, -hat(&rows[0])),
        (2, 0, -hat(&rows[1])),
        (2, 1, hat(&rows[0])),
    ] {
        second.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&block);
    }
    SMatrix::<f64, 9, 9>::identity() * (2.0 * psi_I)
        + second * psi_J
        + (f * c.transpose() + c * f.transpose()) * (2.0 * psi_IJ)
        + c * c.transpose() * psi_JJ
}

/// The matrix that takes the cross product with a.
fn hat(a: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0)
}
