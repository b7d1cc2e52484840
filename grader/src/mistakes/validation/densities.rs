//! The energy density and its derivatives.

use nalgebra::{Matrix3, SMatrix, SVector};

use super::super::Mistake;
use super::super::by_hand::{by_rows, cofactors, second_derivative_of_J};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(psi_neo_hookean, ["scaled by 2"], |F, C, D| 2.0 * right!(psi_neo_hookean(F, C, D))),
    wrong!(psi_neo_hookean, ["the term with D with the wrong sign"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 { f64::INFINITY } else { C * (J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0) - D * (J - 1.0).powi(2) }
    }),
    wrong!(psi_neo_hookean, ["infinite under compression", "infinite for compressed"], |F, C, D| {
        if F.determinant() < 1.0 { f64::INFINITY } else { right!(psi_neo_hookean(F, C, D)) }
    }),
    wrong!(psi_neo_hookean, ["squared too much", "the first term squared", "squared as a whole"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            f64::INFINITY
        } else {
            C * (J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0).powi(2) + D * (J - 1.0).powi(2)
        }
    }),
    wrong!(psi_neo_hookean, ["wrong exponent", "power of F"], |F, C, D| {
        // J^(−2/3) on the norm before it is squared.
        let J = F.determinant();
        if J <= 0.0 {
            f64::INFINITY
        } else {
            C * ((F * J.powf(-2.0 / 3.0)).norm_squared() - 3.0) + D * (J - 1.0).powi(2)
        }
    }),
    wrong!(
        psi_neo_hookean,
        ["negative determinant accepted", "finite for inverted", "finite in a limiting case"],
        |F, C, D| {
            let J = F.determinant();
            C * ((J * J).powf(-1.0 / 3.0) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2)
        }
    ),
    wrong!(psi_neo_hookean, ["missing the term with C", "missing C", "missing term"], |F, _, D| {
        let J = F.determinant();
        if J <= 0.0 { f64::INFINITY } else { J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0 + D * (J - 1.0).powi(2) }
    }),
    wrong!(dpsi_neo_hookean_dF, ["scaled by 0.5"], |F, C, D| right!(dpsi_neo_hookean_dF(F, C, D)) * 0.5),
    wrong!(dpsi_neo_hookean_dF, ["missing the term with D", "missing term"], |F, C, D| right!(dpsi_neo_hookean_dF(
        F,
        C,
        0.0 * D
    ))),
    wrong!(dpsi_neo_hookean_dF, ["C and D swapped"], |F, C, D| right!(dpsi_neo_hookean_dF(F, D, C))),
    wrong!(
        dpsi_neo_hookean_dF,
        ["derivative of the power of J with the wrong factor", "the derivative of the power of J scaled by 0.5"],
        |F, C, D| { stress(F, C, D, |J| J.powf(-2.0 / 3.0), |J| -J.powf(-5.0 / 3.0) / 3.0, |J| 2.0 * (J - 1.0)) }
    ),
    wrong!(dpsi_neo_hookean_dF, ["wrong exponent"], |F, C, D| {
        stress(F, C, D, |J| J.powf(-2.0 / 3.0), |J| -2.0 / 3.0 * J.powf(-1.0 / 3.0), |J| 2.0 * (J - 1.0))
    }),
    wrong!(dpsi_neo_hookean_dF, ["inverse for inverse transpose", "cofactors transposed"], |F, C, D| {
        let (J, I, g) = (F.determinant(), F.norm_squared(), F.determinant().powf(-2.0 / 3.0));
        let inverse = F.try_inverse().unwrap_or_default();
        by_rows(&(F * (2.0 * C * g) + inverse * (-2.0 / 3.0 * C * I * g + 2.0 * D * (J - 1.0) * J)))
    }),
    // The stress of the energy without J^(−2/3) and −3.
    wrong!(
        dpsi_neo_hookean_dF,
        [
            "wrong exponent",
            "missing power of J",
            "another material",
            "wrong exponent and missing the derivative of the power of J"
        ],
        |F, C, D| { stress(F, C, D, |_| 1.0, |_| 0.0, |J| 2.0 * (J - 1.0)) }
    ),
    wrong!(dpsi_neo_hookean_dF, ["missing −1"], |F, C, D| {
        stress(F, C, D, |J| J.powf(-2.0 / 3.0), |J| -2.0 / 3.0 * J.powf(-5.0 / 3.0), |J| 2.0 * J)
    }),
    wrong!(dpsi_neo_hookean_dF, ["only diagonal", "only the diagonal of the stress"], |F, C, D| {
        let P = right!(dpsi_neo_hookean_dF(F, C, D));
        SVector::from_fn(|i, _| if i % 4 == 0 { P[i] } else { 0.0 })
    }),
    // A cofactor with the wrong sign: the (0, 1) minor is not negated.
    wrong!(
        dpsi_neo_hookean_dF,
        [
            "in some entries the derivative of the power of J with the wrong sign and the term with D with the wrong sign",
            "minors without their signs",
            "sign of one cofactor"
        ],
        |F, C, D| {
            let mut cof = cofactors(F);
            cof[(0, 1)] = -cof[(0, 1)];
            let (J, I, g) = (F.determinant(), F.norm_squared(), F.determinant().powf(-2.0 / 3.0));
            by_rows(&(F * (2.0 * C * g) + cof * (-2.0 / 3.0 * C * I * g / J + 2.0 * D * (J - 1.0))))
        }
    ),
    wrong!(d2psi_neo_hookean_dF2, ["scaled by 2"], |F, C, D| right!(d2psi_neo_hookean_dF2(F, C, D)) * 2.0),
    wrong!(d2psi_neo_hookean_dF2, ["C and D swapped"], |F, C, D| right!(d2psi_neo_hookean_dF2(F, D, C))),
    wrong!(d2psi_neo_hookean_dF2, ["missing the square of the cofactors with C"], |F, C, D| {
        let (J, I, g) = (F.determinant(), F.norm_squared(), F.determinant().powf(-2.0 / 3.0));
        let k = by_rows(&cofactors(F));
        right!(d2psi_neo_hookean_dF2(F, C, D)) - k * k.transpose() * (10.0 / 9.0 * C * I * g / (J * J))
    }),
    wrong!(
        d2psi_neo_hookean_dF2,
        ["the square of the cofactors with C scaled by -1", "the square of the cofactors with C with the wrong sign"],
        |F, C, D| {
            let (J, I, g) = (F.determinant(), F.norm_squared(), F.determinant().powf(-2.0 / 3.0));
            let k = by_rows(&cofactors(F));
            right!(d2psi_neo_hookean_dF2(F, C, D)) - k * k.transpose() * (20.0 / 9.0 * C * I * g / (J * J))
        }
    ),
    wrong!(
        d2psi_neo_hookean_dF2,
        ["missing −1", "the derivative of the cofactors with D with another factor"],
        |F, C, D| { right!(d2psi_neo_hookean_dF2(F, C, D)) + second_derivative_of_J(F) * (2.0 * D) }
    ),
    // F ⊗ F instead of F ⊗ cof.
    wrong!(
        d2psi_neo_hookean_dF2,
        ["F for the cofactors", "the product of F and the cofactors with another factor"],
        |F, C, D| {
            let (J, g) = (F.determinant(), F.determinant().powf(-2.0 / 3.0));
            let (f, k) = (by_rows(F), by_rows(&cofactors(F)));
            let mixed = f * k.transpose() + k * f.transpose();
            right!(d2psi_neo_hookean_dF2(F, C, D)) + (mixed - f * f.transpose() * 2.0) * (4.0 / 3.0 * C * g / J)
        }
    ),
    wrong!(d2psi_neo_hookean_dF2, ["the term along the identity scaled by 0.5"], |F, C, D| {
        right!(d2psi_neo_hookean_dF2(F, C, D)) - SMatrix::identity() * (C * F.determinant().powf(-2.0 / 3.0))
    }),
    wrong!(d2psi_neo_hookean_dF2, ["only lower triangle"], |F, C, D| {
        let H = right!(d2psi_neo_hookean_dF2(F, C, D));
        SMatrix::from_fn(|i, j| if i >= j { H[(i, j)] } else { 0.0 })
    }),
    // The upper triangle is copied to the lower one and added to the diagonal a second time.
    wrong!(d2psi_neo_hookean_dF2, ["the diagonal scaled by 2"], |F, C, D| {
        let H = right!(d2psi_neo_hookean_dF2(F, C, D));
        SMatrix::from_fn(|i, j| if i == j { 2.0 * H[(i, j)] } else { H[(i, j)] })
    }),
    wrong!(d2psi_neo_hookean_dF2, ["finite differences", "inexact"], |F, C, D| {
        let h = 1e-4;
        SMatrix::from_fn(|i, j| {
            let mut step = Matrix3::zeros();
            step[(j / 3, j % 3)] = h;
            let (ahead, behind) =
                (right!(dpsi_neo_hookean_dF(&(F + step), C, D)), right!(dpsi_neo_hookean_dF(&(F - step), C, D)));
            (ahead[i] - behind[i]) / (2.0 * h)
        })
    }),
    wrong!(
        d2psi_neo_hookean_dF2,
        ["entries exchanged", "only rows by columns", "columns for rows on one side"],
        |F, C, D| {
            // Rows are flattened by rows, columns by columns.
            let H = right!(d2psi_neo_hookean_dF2(F, C, D));
            SMatrix::from_fn(|i, j| H[(i, 3 * (j % 3) + j / 3)])
        }
    ),
];

fn stress(
    F: &Matrix3<f64>,
    C: f64,
    D: f64,
    g: fn(f64) -> f64,
    dg: fn(f64) -> f64,
    dD: fn(f64) -> f64,
) -> SVector<f64, 9> {
    let J = F.determinant();
    by_rows(&(F * (2.0 * C * g(J)) + cofactors(F) * (C * F.norm_squared() * dg(J) + D * dD(J))))
}
