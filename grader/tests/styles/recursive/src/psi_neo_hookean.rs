use nalgebra::Matrix3;

/// The determinant by expansion along the first row.
pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let rows: Vec<Vec<f64>> = F.row_iter().map(|row| row.iter().copied().collect()).collect();
    let J = determinant(&rows);
    if !(J > 0.0) {
        return f64::INFINITY;
    }
    let trace: f64 = rows.iter().flatten().map(|entry| entry.powi(2)).sum();
    C * (trace * J.powf(-2.0 / 3.0) - 3.0) + D * (J - 1.0).powi(2)
}

fn determinant(rows: &[Vec<f64>]) -> f64 {
    let Some((first, below)) = rows.split_first() else { return 1.0 };
    let without = |column: usize| -> Vec<Vec<f64>> {
        below.iter().map(|row| [&row[..column], &row[column + 1..]].concat()).collect()
    };
    let term = |column: usize| first[column] * determinant(&without(column)) * if column % 2 == 0 { 1.0 } else { -1.0 };
    (0..first.len()).map(term).sum()
}
