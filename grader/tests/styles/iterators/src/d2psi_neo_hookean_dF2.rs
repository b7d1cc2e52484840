use nalgebra::{Matrix3, SMatrix, SVector};

/// Each column is the change of the stress as one entry of F changes, with the inverse transpose G.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let J = F.determinant();
    let G = F.try_inverse().expect("J > 0").transpose();
    let (shape, I) = (J.powf(-2.0 / 3.0), F.norm_squared());
    let change = |dF: Matrix3<f64>| {
        let (t, s) = (G.dot(&dF), F.dot(&dF));
        let turned = G * dF.transpose() * G;
        let of_shape = dF - G * (2.0 / 3.0 * s) - F * (2.0 / 3.0 * t) + G * (2.0 / 9.0 * I * t) + turned * (I / 3.0);
        let of_volume = G * ((2.0 * J - 1.0) * J * t) - turned * (J * (J - 1.0));
        of_shape * (2.0 * C * shape) + of_volume * (2.0 * D)
    };
    let columns: Vec<SVector<f64, 9>> = (0..9)
        .map(|k| {
            let mut dF = Matrix3::zeros();
            dF[(k / 3, k % 3)] = 1.0;
            // The transpose, column by column, is the matrix row by row.
            SVector::from_iterator(change(dF).transpose().iter().copied())
        })
        .collect();
    SMatrix::from_columns(&columns)
}
