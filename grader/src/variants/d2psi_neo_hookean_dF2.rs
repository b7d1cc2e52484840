//! Mistakes in `d2psi_neo_hookean_dF2`.

use finite_elements_3d as solved;
use nalgebra::{Matrix3, SMatrix, SVector};

use super::Variant;

type Matrix9 = SMatrix<f64, 9, 9>;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        d2psi_neo_hookean_dF2,
        "missing term",
        "Under strong deformation something is missing: J is not linear in F, so it has a second derivative.",
        |F, C, D| solved::d2psi_neo_hookean_dF2(F, C, D) - second_of_J(F) * factor_of_second(F, C, D)
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "one mixed product",
        "The matrix is not symmetric. The product rule gives two mixed products, one the transpose of the other.",
        |F, C, D| solved::d2psi_neo_hookean_dF2(F, C, D) - mixed(F, C)
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "no mixed products",
        "Both mixed products of the first term are missing: the trace and the power of J change at the same time.",
        |F, C, D| solved::d2psi_neo_hookean_dF2(F, C, D) - mixed(F, C) - mixed(F, C).transpose()
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "sign of the second derivative of J",
        "With C = 0 compare with finite differences: some blocks have the opposite sign.",
        |F, C, D| solved::d2psi_neo_hookean_dF2(F, C, D) - second_of_J(F) * (2.0 * factor_of_second(F, C, D))
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "columns for rows",
        "The entries are right, but F is flattened column by column; the course flattens row by row.",
        |F, C, D| {
            let H = solved::d2psi_neo_hookean_dF2(F, C, D);
            Matrix9::from_fn(|row, column| H[(swapped(row), swapped(column))])
        }
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "columns for rows on one side",
        "The rows are flattened one way and the columns another, so the matrix is not symmetric.",
        |F, C, D| {
            let H = solved::d2psi_neo_hookean_dF2(F, C, D);
            Matrix9::from_fn(|row, column| H[(row, swapped(column))])
        }
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "projected",
        "Negative curvature is real and must be returned as it is; projection comes later, and elsewhere.",
        |F, C, D| {
            let mut eigen = solved::d2psi_neo_hookean_dF2(F, C, D).symmetric_eigen();
            eigen.eigenvalues.apply(|value| *value = value.max(0.0));
            eigen.recompose()
        }
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "negated",
        "The sign is reversed: the page asks for the second derivative of an energy, which is stiff at rest.",
        |F, C, D| -solved::d2psi_neo_hookean_dF2(F, C, D)
    ),
    variant!(
        d2psi_neo_hookean_dF2,
        "scaled by 0.5",
        "The answer is half of what it should be: compare it with finite differences of the first derivative.",
        |F, C, D| solved::d2psi_neo_hookean_dF2(F, C, D) * 0.5
    ),
];

/// Index of an entry after the exchange of rows and columns.
fn swapped(entry: usize) -> usize {
    3 * (entry % 3) + entry / 3
}

/// One of the two mixed products.
fn mixed(F: &Matrix3<f64>, C: f64) -> Matrix9 {
    let flat = |A: Matrix3<f64>| SVector::<f64, 9>::from_column_slice(A.transpose().as_slice());
    let J = F.determinant();
    let inverse = F.try_inverse().unwrap_or_default();
    let factor = -4.0 / 3.0 * C * J.cbrt().powi(-2);
    flat(*F) * flat(inverse.transpose()).transpose() * factor
}

/// Factor of the second derivative of J.
fn factor_of_second(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.determinant();
    2.0 * D * (J - 1.0) - 2.0 / 3.0 * C * F.norm_squared() * J.cbrt().powi(-5)
}

fn second_of_J(F: &Matrix3<f64>) -> Matrix9 {
    let J = F.determinant();
    let G = F.try_inverse().unwrap_or_default().transpose();
    Matrix9::from_fn(|row, column| {
        let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
        J * (G[(i, j)] * G[(k, l)] - G[(i, l)] * G[(k, j)])
    })
}
