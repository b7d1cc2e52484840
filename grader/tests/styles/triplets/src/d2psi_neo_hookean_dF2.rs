use nalgebra::{Matrix3, SMatrix};

/// A list of entries, most places more than once, that is added up in the end.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let J = F.determinant();
    let G = F.try_inverse().expect("J > 0").transpose();
    let (I, shape) = (F.norm_squared(), C * J.powf(-2.0 / 3.0));
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    for row in 0..9 {
        let (i, j) = (row / 3, row % 3);
        entries.push((row, row, 2.0 * shape));
        for column in 0..9 {
            let (k, l) = (column / 3, column % 3);
            entries.push((row, column, -4.0 / 3.0 * shape * F[(i, j)] * G[(k, l)]));
            entries.push((row, column, -4.0 / 3.0 * shape * G[(i, j)] * F[(k, l)]));
            entries.push((row, column, 4.0 / 9.0 * shape * I * G[(i, j)] * G[(k, l)]));
            entries.push((row, column, 2.0 / 3.0 * shape * I * G[(i, l)] * G[(k, j)]));
            entries.push((row, column, 2.0 * D * J * (2.0 * J - 1.0) * G[(i, j)] * G[(k, l)]));
            entries.push((row, column, -2.0 * D * J * (J - 1.0) * G[(i, l)] * G[(k, j)]));
        }
    }
    let mut H = SMatrix::zeros();
    for (row, column, value) in entries {
        H[(row, column)] += value;
    }
    H
}
