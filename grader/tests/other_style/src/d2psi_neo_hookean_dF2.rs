use nalgebra::{Matrix3, SMatrix};

/// The sign of a permutation of the three axes, zero where an axis repeats.
fn levi_civita(i: usize, j: usize, k: usize) -> f64 {
    let (i, j, k) = (i as i32, j as i32, k as i32);
    f64::from((j - i) * (k - j) * (k - i) / 2)
}

/// ∂²J/∂F_ij∂F_kl, summed over all of the axes that are left.
fn second_derivative_of_determinant(F: &Matrix3<f64>, i: usize, j: usize, k: usize, l: usize) -> f64 {
    (0..3)
        .flat_map(|m| (0..3).map(move |n| (m, n)))
        .map(|(m, n)| levi_civita(i, k, m) * levi_civita(j, l, n) * F[(m, n)])
        .sum()
}

/// ∂J/∂F_ij, half of the same sum once more.
fn derivative_of_determinant(F: &Matrix3<f64>, i: usize, j: usize) -> f64 {
    0.5 * (0..9).map(|e| second_derivative_of_determinant(F, i, j, e / 3, e % 3) * F[(e / 3, e % 3)]).sum::<f64>()
}

/// Hessian of the energy density, entry by entry.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let dJ = Matrix3::from_fn(|i, j| derivative_of_determinant(F, i, j));
    let J = F.component_mul(&dJ).sum() / 3.0;
    let I = F.dot(F);
    let power = |p: f64| C * J.powf(p);
    SMatrix::from_fn(|row, column| {
        let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
        let same = if row == column { 1.0 } else { 0.0 };
        let (a, b) = (dJ[(i, j)], dJ[(k, l)]);
        let d2J = second_derivative_of_determinant(F, i, j, k, l);
        2.0 * power(-2.0 / 3.0) * same - 4.0 / 3.0 * power(-5.0 / 3.0) * (F[(i, j)] * b + a * F[(k, l)])
            + 10.0 / 9.0 * I * power(-8.0 / 3.0) * a * b
            - 2.0 / 3.0 * I * power(-5.0 / 3.0) * d2J
            + 2.0 * D * (a * b + (J - 1.0) * d2J)
    })
}
