//! Mistakes in `dpsi_neo_hookean_dF`.

use finite_elements_3d as solved;
use nalgebra::{Matrix3, SVector};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        dpsi_neo_hookean_dF,
        "columns for rows",
        "The nine numbers are right, but flattened column by column; the course flattens row by row.",
        |F, C, D| {
            let P = Matrix3::from_row_slice(solved::dpsi_neo_hookean_dF(F, C, D).as_slice());
            SVector::from_column_slice(P.as_slice())
        }
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "inverse for inverse transpose",
        "Try an F that is not symmetric: the derivative of J has its indices the other way round.",
        |F, C, D| {
            let inverse = F.try_inverse().unwrap_or_default();
            rows(&(on_F(F, C) + inverse * along_cofactor(F, C, D)))
        }
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "missing term",
        "Every factor that depends on F must be differentiated, also the power of J in front of the trace.",
        |F, C, D| {
            let inverse = F.try_inverse().unwrap_or_default().transpose();
            rows(&(on_F(F, C) + inverse * along_cofactor(F, 0.0, D)))
        }
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "scaled by 0.5",
        "The answer is half of what it should be: think of the derivative of a square.",
        |F, C, D| solved::dpsi_neo_hookean_dF(F, C, D) * 0.5
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "missing volume part",
        "The answer does not depend on D. The second term of the energy has a derivative too.",
        |F, C, _| solved::dpsi_neo_hookean_dF(F, C, 0.0)
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "lost 2 in the volume part",
        "With C = 0 half of the answer is missing: the second term of the energy is a square.",
        |F, C, D| solved::dpsi_neo_hookean_dF(F, C, 0.5 * D)
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "negated",
        "The sign is reversed: the page asks for the derivative of the energy, not a force.",
        |F, C, D| -solved::dpsi_neo_hookean_dF(F, C, D)
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "C and D swapped",
        "Each constant weighs the other's term. Which one resists a change of shape?",
        |F, C, D| solved::dpsi_neo_hookean_dF(F, D, C)
    ),
    variant!(
        dpsi_neo_hookean_dF,
        "wrong exponent",
        "Blow the body up uniformly: the stress may come from the change of volume alone. Look at the powers of J.",
        |F, C, D| {
            let inverse = F.try_inverse().unwrap_or_default().transpose();
            let J = F.determinant();
            rows(&(on_F(F, C) * J.cbrt() + inverse * along_cofactor(F, C, D)))
        }
    ),
];

/// The part of the stress along F.
fn on_F(F: &Matrix3<f64>, C: f64) -> Matrix3<f64> {
    F * (2.0 * C * F.determinant().cbrt().powi(-2))
}

/// The factor of the transposed inverse of F in the rest of the stress.
fn along_cofactor(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.determinant();
    2.0 * D * (J - 1.0) * J - 2.0 / 3.0 * C * J.cbrt().powi(-2) * F.norm_squared()
}

fn rows(P: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_column_slice(P.transpose().as_slice())
}
