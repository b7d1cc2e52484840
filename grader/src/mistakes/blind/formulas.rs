//! Springs and energy densities.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // the difference of the squares in place of the square of the difference
    wrong!(V_spring_particle_particle, ["difference of squares"], |q0, q1, l0, stiffness| {
        0.5 * stiffness * ((q1 - q0).norm_squared() - l0 * l0)
    }),
    // no energy in compression
    wrong!(V_spring_particle_particle, ["only under tension"], |q0, q1, l0, stiffness| {
        let length = (q1 - q0).norm();
        if length < l0 { 0.0 } else { 0.5 * stiffness * (length - l0).powi(2) }
    }),
    // strain in place of the change of length
    wrong!(V_spring_particle_particle, ["relative stretch"], |q0, q1, l0, stiffness| {
        let strain = ((q1 - q0).norm() - l0) / l0;
        0.5 * stiffness * strain * strain
    }),
    // sign: the force in place of the gradient
    wrong!(dV_spring_particle_particle_dq, ["negated"], |q0, q1, l0, stiffness| {
        let d = q1 - q0;
        let n = if d.norm() == 0.0 { Vector3::zeros() } else { d.normalize() };
        let f = stiffness * (d - l0 * n);
        SVector::<f64, 6>::from_column_slice(&[f.x, f.y, f.z, -f.x, -f.y, -f.z])
    }),
    // direction not normalised
    wrong!(dV_spring_particle_particle_dq, ["direction not normalised"], |q0, q1, l0, stiffness| {
        let d = q1 - q0;
        let f = stiffness * (d.norm() - l0) * d;
        SVector::<f64, 6>::from_column_slice(&[-f.x, -f.y, -f.z, f.x, f.y, f.z])
    }),
    // 0/0 where the ends coincide
    wrong!(dV_spring_particle_particle_dq, ["NaN at zero length"], |q0, q1, l0, stiffness| {
        let d = q1 - q0;
        let f = stiffness * (d.norm() - l0) * d / d.norm();
        SVector::<f64, 6>::from_column_slice(&[-f.x, -f.y, -f.z, f.x, f.y, f.z])
    }),
    // first half has the wrong sign
    wrong!(dV_spring_particle_particle_dq, ["the first end with the wrong sign"], |q0, q1, l0, stiffness| {
        let d = q1 - q0;
        let n = if d.norm() == 0.0 { Vector3::zeros() } else { d.normalize() };
        let f = stiffness * (d - l0 * n);
        SVector::<f64, 6>::from_column_slice(&[f.x, f.y, f.z, f.x, f.y, f.z])
    }),
    // sign of the exponent
    wrong!(psi_neo_hookean, ["sign of the exponent"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            return f64::INFINITY;
        }
        C * (J.powf(2.0 / 3.0) * (F.transpose() * F).trace() - 3.0) + D * (J - 1.0).powi(2)
    }),
    // J^(-2/3) multiplies the 3 as well
    wrong!(psi_neo_hookean, ["3 inside the product"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            return f64::INFINITY;
        }
        C * J.powf(-2.0 / 3.0) * ((F.transpose() * F).trace() - 3.0) + D * (J - 1.0).powi(2)
    }),
    // logarithm in place of J - 1
    wrong!(psi_neo_hookean, ["another volume term"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            return f64::INFINITY;
        }
        C * (J.powf(-2.0 / 3.0) * (F.transpose() * F).trace() - 3.0) + D * J.ln().powi(2)
    }),
    // J <= 0 not refused: NaN
    wrong!(psi_neo_hookean, ["NaN in a limiting case"], |F, C, D| {
        let J = F.determinant();
        C * (J.powf(-2.0 / 3.0) * (F.transpose() * F).trace() - 3.0) + D * (J - 1.0).powi(2)
    }),
    // J of FtF: squared
    wrong!(psi_neo_hookean, ["determinant of FᵀF"], |F, C, D| {
        let E = F.transpose() * F;
        let J = E.determinant();
        if F.determinant() <= 0.0 {
            return f64::INFINITY;
        }
        C * (J.powf(-2.0 / 3.0) * E.trace() - 3.0) + D * (J - 1.0).powi(2)
    }),
    // exponent 0 (integer division)
    wrong!(psi_neo_hookean, ["power of J without effect"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            return f64::INFINITY;
        }
        C * (J.powi(-2 / 3) * (F.transpose() * F).trace() - 3.0) + D * (J - 1.0).powi(2)
    }),
    // flattened by columns
    wrong!(dpsi_neo_hookean_dF, ["columns for rows"], |F, C, D| {
        let J = F.determinant();
        let cof = J * F.try_inverse().unwrap().transpose();
        let I = F.norm_squared();
        let P = 2.0 * C * J.powf(-2.0 / 3.0) * F + (2.0 * D * (J - 1.0) - 2.0 / 3.0 * C * J.powf(-5.0 / 3.0) * I) * cof;
        SVector::<f64, 9>::from_column_slice(P.as_slice())
    }),
    // derivative of J^(-2/3) left out
    wrong!(dpsi_neo_hookean_dF, ["missing term"], |F, C, D| {
        let J = F.determinant();
        let cof = J * F.try_inverse().unwrap().transpose();
        let P = 2.0 * C * J.powf(-2.0 / 3.0) * F + 2.0 * D * (J - 1.0) * cof;
        SVector::<f64, 9>::from_column_slice(P.transpose().as_slice())
    }),
    // cofactor transposed
    wrong!(dpsi_neo_hookean_dF, ["inverse for inverse transpose"], |F, C, D| {
        let J = F.determinant();
        let cof = J * F.try_inverse().unwrap();
        let I = F.norm_squared();
        let P = 2.0 * C * J.powf(-2.0 / 3.0) * F + (2.0 * D * (J - 1.0) - 2.0 / 3.0 * C * J.powf(-5.0 / 3.0) * I) * cof;
        SVector::<f64, 9>::from_column_slice(P.transpose().as_slice())
    }),
    // one cross product in the wrong order
    wrong!(dpsi_neo_hookean_dF, ["cofactors with the wrong sign in part"], |F, C, D| {
        let (a, b, c) = (F.row(0).transpose(), F.row(1).transpose(), F.row(2).transpose());
        let cof = Matrix3::from_rows(&[b.cross(&c).transpose(), a.cross(&c).transpose(), a.cross(&b).transpose()]);
        let J = F.determinant();
        let I = F.norm_squared();
        let P = 2.0 * C * J.powf(-2.0 / 3.0) * F + (2.0 * D * (J - 1.0) - 2.0 / 3.0 * C * J.powf(-5.0 / 3.0) * I) * cof;
        SVector::<f64, 9>::from_column_slice(P.transpose().as_slice())
    }),
    // exponent of J not lowered by one
    wrong!(dpsi_neo_hookean_dF, ["factor J too many"], |F, C, D| {
        let J = F.determinant();
        let cof = J * F.try_inverse().unwrap().transpose();
        let P = 2.0 * C * J.powf(-2.0 / 3.0) * F
            + (2.0 * D * (J - 1.0) - 2.0 / 3.0 * C * J.powf(-2.0 / 3.0) * F.norm_squared()) * cof;
        SVector::<f64, 9>::from_column_slice(P.transpose().as_slice())
    }),
    // one of the two mixed products left out
    wrong!(d2psi_neo_hookean_dF2, ["missing the product of the cofactors and F"], |F, C, D| {
        hessian(F, C, D, "one product")
    }),
    // 4/9 in place of 10/9 in psi_JJ
    wrong!(d2psi_neo_hookean_dF2, ["the square of the cofactors with C scaled by 0.4"], |F, C, D| {
        hessian(F, C, D, "4/9")
    }),
    // sign of one cross product block
    wrong!(d2psi_neo_hookean_dF2, ["one block with the wrong sign"], |F, C, D| { hessian(F, C, D, "one hat") }),
    // second derivative of I without its 2
    wrong!(d2psi_neo_hookean_dF2, ["the term along the identity scaled by 0.5"], |F, C, D| {
        hessian(F, C, D, "identity")
    }),
    // psi_J without its C term
    wrong!(d2psi_neo_hookean_dF2, ["missing the derivative of the cofactors with C"], |F, C, D| {
        hessian(F, C, D, "volumetric psi_J")
    }),
    // cofactor flattened by columns, F by rows
    wrong!(d2psi_neo_hookean_dF2, ["cofactors flattened by columns"], |F, C, D| {
        hessian(F, C, D, "cofactor by columns")
    }),
];

fn hat(a: Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}
fn hessian(F: &Matrix3<f64>, C: f64, D: f64, slip: &str) -> SMatrix<f64, 9, 9> {
    let rows = [0, 1, 2].map(|i| F.row(i).transpose());
    let (J, I) = (F.determinant(), F.norm_squared());
    let cof = J * F.try_inverse().unwrap().transpose();
    let f = SVector::<f64, 9>::from_column_slice(F.transpose().as_slice());
    let c = SVector::<f64, 9>::from_column_slice(
        if slip == "cofactor by columns" { cof } else { cof.transpose() }.as_slice(),
    );
    let psi_I = C * J.powf(-2.0 / 3.0);
    let psi_J = -2.0 / 3.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0);
    let psi_IJ = -2.0 / 3.0 * C * J.powf(-5.0 / 3.0);
    let psi_JJ = match slip {
        "4/9" => 4.0 / 9.0 * C * I * J.powf(-8.0 / 3.0) + 2.0 * D,
        _ => 10.0 / 9.0 * C * I * J.powf(-8.0 / 3.0) + 2.0 * D,
    };
    let mut d2J = SMatrix::<f64, 9, 9>::zeros();
    for (row, column, k, sign) in
        [(0, 1, 2, -1.0), (0, 2, 1, 1.0), (1, 0, 2, 1.0), (1, 2, 0, -1.0), (2, 0, 1, -1.0), (2, 1, 0, 1.0)]
    {
        let sign = if slip == "one hat" && (row, column) == (2, 1) { -1.0 } else { sign };
        d2J.fixed_view_mut::<3, 3>(3 * row, 3 * column).copy_from(&(sign * hat(rows[k])));
    }
    let mixed = match slip {
        "one product" => f * c.transpose() * 2.0,
        _ => f * c.transpose() * 2.0 + c * f.transpose() * 2.0,
    };
    let on_identity = if slip == "identity" { 1.0 } else { 2.0 };
    let psi_J = if slip == "volumetric psi_J" { 2.0 * D * (J - 1.0) } else { psi_J };
    SMatrix::<f64, 9, 9>::identity() * on_identity * psi_I + d2J * psi_J + mixed * psi_IJ + c * c.transpose() * psi_JJ
}
