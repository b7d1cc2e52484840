use nalgebra::{Matrix3, SVector, Vector3};

/// Row by row, with cross products for the cofactors.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let rows: Vec<Vector3<f64>> = F.row_iter().map(|row| row.transpose()).collect();
    let cofactors = [(1, 2), (2, 0), (0, 1)].map(|(a, b)| rows[a].cross(&rows[b]));
    let J = rows[0].dot(&cofactors[0]);
    let shape = 2.0 * C / J.cbrt().powi(2);
    let squares: f64 = rows.iter().map(|row| row.norm_squared()).sum();
    let volume = 2.0 * D * (J - 1.0) - shape * squares / (3.0 * J);
    SVector::from_iterator(rows.iter().zip(&cofactors).flat_map(|(row, cofactor)| {
        let both = row * shape + cofactor * volume;
        [both.x, both.y, both.z]
    }))
}
