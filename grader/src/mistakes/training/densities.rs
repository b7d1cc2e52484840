//! The energy density and its derivatives.

use nalgebra::{Matrix3, SMatrix};

use super::super::Mistake;
use super::super::by_hand::{by_columns, by_rows, cofactors, density, hessian, stress};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(psi_neo_hookean, ["the term with D scaled by 0.5", "D scaled by 0.5"], |F, C, D| density(F, |J, I| C
        * (J.powf(-2.0 / 3.0) * I - 3.0)
        + 0.5 * D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["scaled by 0.5"], |F, C, D| density(F, |J, I| 0.5 * C * (J.powf(-2.0 / 3.0) * I - 3.0)
        + 0.5 * D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["another material"], |F, C, D| density(F, |J, I| C * (I - 3.0 - 2.0 * J.ln())
        + D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["another volume term"], |F, C, D| density(F, |J, I| C * (J.powf(-2.0 / 3.0) * I - 3.0)
        + D * J.ln().powi(2))),
    wrong!(psi_neo_hookean, ["3 without C"], |F, C, D| density(F, |J, I| C * J.powf(-2.0 / 3.0) * I - 3.0
        + D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["root of the trace"], |F, C, D| density(F, |J, I| C
        * (J.powf(-2.0 / 3.0) * I.sqrt() - 3.0)
        + D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["another volume term"], |F, C, D| density(F, |J, I| C * (J.powf(-2.0 / 3.0) * I - 3.0)
        + D * (J * J - 1.0))),
    wrong!(psi_neo_hookean, ["finite in a limiting case"], |F, C, D| {
        if F.determinant() <= 0.0 { 0.0 } else { right!(psi_neo_hookean(F, C, D)) }
    }),
    wrong!(psi_neo_hookean, ["wrong constant"], |F, C, D| density(F, |J, I| C * (J.powf(-2.0 / 3.0) * I - 2.0)
        + D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["another material and the term with D scaled by 0.5"], |F, C, D| {
        let E = (F.transpose() * F - Matrix3::identity()) * 0.5;
        C * E.norm_squared() + 0.5 * D * E.trace().powi(2)
    }),
    wrong!(dpsi_neo_hookean_dF, ["the term along F scaled by 0.5"], |F, C, D| stress(F, |J, I, g| (
        C * g,
        -2.0 / 3.0 * C * I * g / J + 2.0 * D * (J - 1.0)
    ))),
    wrong!(dpsi_neo_hookean_dF, ["lost 2 in the volume part", "D scaled by 0.5"], |F, C, D| stress(F, |J, I, g| (
        2.0 * C * g,
        -2.0 / 3.0 * C * I * g / J + D * (J - 1.0)
    ))),
    wrong!(dpsi_neo_hookean_dF, ["missing term"], |F, C, D| stress(F, |J, _, g| (2.0 * C * g, 2.0 * D * (J - 1.0)))),
    wrong!(dpsi_neo_hookean_dF, ["the derivative of the power of J with the wrong sign"], |F, C, D| stress(
        F,
        |J, I, g| (2.0 * C * g, 2.0 / 3.0 * C * I * g / J + 2.0 * D * (J - 1.0))
    )),
    wrong!(dpsi_neo_hookean_dF, ["not differentiated"], |F, C, D| stress(F, |J, I, g| (
        2.0 * C * g,
        -2.0 / 3.0 * C * I * g / J + 2.0 * D * (J - 1.0).powi(2)
    ))),
    wrong!(dpsi_neo_hookean_dF, ["trace less 3"], |F, C, D| stress(F, |J, I, g| (
        2.0 * C * g,
        -2.0 / 3.0 * C * (I - 3.0) * g / J + 2.0 * D * (J - 1.0)
    ))),
    wrong!(dpsi_neo_hookean_dF, ["factor J too many"], |F, C, D| stress(F, |J, I, g| (
        2.0 * C * g,
        -2.0 / 3.0 * C * I * g + 2.0 * D * (J - 1.0)
    ))),
    wrong!(dpsi_neo_hookean_dF, ["factor J missing"], |F, C, D| stress(F, |J, I, g| (
        2.0 * C * g,
        -2.0 / 3.0 * C * I * g / J + 2.0 * D * (J - 1.0) / J
    ))),
    wrong!(dpsi_neo_hookean_dF, ["inverse for inverse transpose"], |F, C, D| {
        let (J, I) = (F.determinant(), F.norm_squared());
        let g = J.powf(-2.0 / 3.0);
        by_rows(&(F * (2.0 * C * g) + cofactors(F).transpose() * (-2.0 / 3.0 * C * I * g / J + 2.0 * D * (J - 1.0))))
    }),
    wrong!(dpsi_neo_hookean_dF, ["Cauchy stress"], |F, C, D| {
        let P = Matrix3::from_row_slice(right!(dpsi_neo_hookean_dF(F, C, D)).as_slice());
        by_rows(&(P * F.transpose() / F.determinant()))
    }),
    wrong!(dpsi_neo_hookean_dF, ["columns for rows"], |F, C, D| {
        let P = Matrix3::from_row_slice(right!(dpsi_neo_hookean_dF(F, C, D)).as_slice());
        by_columns(&P)
    }),
    wrong!(d2psi_neo_hookean_dF2, ["missing the term along the identity"], |F, C, D| hessian(F, C, D, |c| c[0] = 0.0)),
    wrong!(d2psi_neo_hookean_dF2, ["no mixed products"], |F, C, D| hessian(F, C, D, |c| (c[1], c[2]) = (0.0, 0.0))),
    wrong!(d2psi_neo_hookean_dF2, ["missing the product of the cofactors and F"], |F, C, D| hessian(F, C, D, |c| c
        [2] =
        0.0)),
    wrong!(d2psi_neo_hookean_dF2, ["missing the square of the cofactors with D"], |F, C, D| hessian(F, C, D, |c| c
        [3] =
        0.0)),
    wrong!(d2psi_neo_hookean_dF2, ["missing term"], |F, C, D| hessian(F, C, D, |c| (c[4], c[5]) = (0.0, 0.0))),
    wrong!(d2psi_neo_hookean_dF2, ["missing the derivative of the cofactors with D"], |F, C, D| hessian(
        F,
        C,
        D,
        |c| c[5] = 0.0
    )),
    wrong!(d2psi_neo_hookean_dF2, ["sign of the second derivative of J"], |F, C, D| hessian(F, C, D, |c| (
        c[4], c[5]
    ) =
        (-c[4], -c[5]))),
    wrong!(d2psi_neo_hookean_dF2, ["the square of the cofactors with C scaled by 0.4"], |F, C, D| hessian(
        F,
        C,
        D,
        |c| c[6] *= 0.4
    )),
    wrong!(d2psi_neo_hookean_dF2, ["the square of the cofactors with D scaled by 0.5"], |F, C, D| hessian(
        F,
        C,
        D,
        |c| c[3] *= 0.5
    )),
    wrong!(d2psi_neo_hookean_dF2, ["only upper triangle"], |F, C, D| {
        let H = right!(d2psi_neo_hookean_dF2(F, C, D));
        SMatrix::from_fn(|i, j| if i <= j { H[(i, j)] } else { 0.0 })
    }),
    wrong!(d2psi_neo_hookean_dF2, ["only diagonal"], |F, C, D| {
        let H = right!(d2psi_neo_hookean_dF2(F, C, D));
        SMatrix::from_fn(|i, j| if i == j { H[(i, j)] } else { 0.0 })
    }),
    wrong!(d2psi_neo_hookean_dF2, ["finite differences"], |F, C, D| {
        let h = 1e-3;
        SMatrix::from_fn(|i, j| {
            let mut moved = *F;
            moved[(j / 3, j % 3)] += h;
            (right!(dpsi_neo_hookean_dF(&moved, C, D))[i] - right!(dpsi_neo_hookean_dF(F, C, D))[i]) / h
        })
    }),
    wrong!(d2psi_neo_hookean_dF2, ["columns for rows"], |F, C, D| right!(d2psi_neo_hookean_dF2(&F.transpose(), C, D))),
];
