use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// The five terms of the page as matrices.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let rows = [F.row(0).transpose(), F.row(1).transpose(), F.row(2).transpose()];
    let J = F.determinant();
    let I = F.norm_squared();
    let f = stacked(&rows);
    let c = stacked(&[rows[1].cross(&rows[2]), rows[2].cross(&rows[0]), rows[0].cross(&rows[1])]);
    let mut bend = SMatrix::<f64, 9, 9>::zeros();
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let hat = rows[k].cross_matrix();
        bend.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&-hat);
        bend.fixed_view_mut::<3, 3>(3 * j, 3 * i).copy_from(&hat);
    }
    let by_I = C * J.powf(-2.0 / 3.0);
    let by_J = 2.0 * D * (J - 1.0) - 2.0 / 3.0 * by_I * I / J;
    let by_IJ = -2.0 / 3.0 * by_I / J;
    let by_JJ = 2.0 * D + 10.0 / 9.0 * by_I * I / (J * J);
    let mixed = f * c.transpose() + c * f.transpose();
    SMatrix::<f64, 9, 9>::identity() * (2.0 * by_I) + bend * by_J + mixed * (2.0 * by_IJ) + c * c.transpose() * by_JJ
}

fn stacked(rows: &[Vector3<f64>; 3]) -> SVector<f64, 9> {
    SVector::from_iterator(rows.iter().flat_map(|row| [row.x, row.y, row.z]))
}
