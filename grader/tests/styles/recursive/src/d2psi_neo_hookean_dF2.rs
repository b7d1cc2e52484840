use nalgebra::{Matrix3, SMatrix};

/// Products of derivatives, with the second derivative of the determinant by minors of minors.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let J = F.determinant();
    let I = F.norm_squared();
    let cofactor = |k: usize| sign(k / 3 + k % 3) * F.remove_row(k / 3).remove_column(k % 3).determinant();
    let entry = |row: usize, column: usize| {
        let (dI, dI_other) = (2.0 * F[(row / 3, row % 3)], 2.0 * F[(column / 3, column % 3)]);
        let (dJ, dJ_other) = (cofactor(row), cofactor(column));
        let d2I = if row == column { 2.0 } else { 0.0 };
        let d2J = second(F, row, column);
        let power = J.powf(-2.0 / 3.0);
        let (dpower, dpower_other) = (-2.0 / 3.0 * power / J * dJ, -2.0 / 3.0 * power / J * dJ_other);
        let d2power = 10.0 / 9.0 * power / (J * J) * dJ * dJ_other - 2.0 / 3.0 * power / J * d2J;
        C * (d2power * I + dpower * dI_other + dpower_other * dI + power * d2I)
            + 2.0 * D * (dJ * dJ_other + (J - 1.0) * d2J)
    };
    SMatrix::from_fn(entry)
}

fn sign(k: usize) -> f64 {
    if k % 2 == 0 { 1.0 } else { -1.0 }
}

/// The derivative of one cofactor by another entry.
fn second(F: &Matrix3<f64>, row: usize, column: usize) -> f64 {
    let ((i, j), (k, l)) = ((row / 3, row % 3), (column / 3, column % 3));
    if i == k || j == l {
        return 0.0;
    }
    // The entry in neither of the two rows and columns remains.
    let (m, n) = (3 - i - k, 3 - j - l);
    let (k, l) = (k - usize::from(k > i), l - usize::from(l > j));
    sign(i + j) * sign(k + l) * F[(m, n)]
}
