//! Shape functions, the material, springs.

use nalgebra::{Matrix3, Matrix4x3, SMatrix, SVector, Vector3, Vector4};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // Ratios of unsigned volumes: nothing is negative outside.
    wrong!(phi_linear_tetrahedron, ["unsigned volumes"], |V, element, x| {
        let vol = |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>, d: Vector3<f64>| {
            (b - a).cross(&(c - a)).dot(&(d - a)).abs() / 6.0
        };
        let [a, b, c, d] = [V[element[0]], V[element[1]], V[element[2]], V[element[3]]];
        let v = vol(a, b, c, d);
        Vector4::new(vol(*x, b, c, d) / v, vol(a, *x, c, d) / v, vol(a, b, *x, d) / v, vol(a, b, c, *x) / v)
    }),
    // phi_0 = 1 + the sum of the others
    wrong!(phi_linear_tetrahedron, ["sum added to one"], |V, element, x| {
        let x0 = V[element[0]];
        let T = Matrix3::from_columns(&[V[element[1]] - x0, V[element[2]] - x0, V[element[3]] - x0]);
        let phi = T.try_inverse().unwrap() * (x - x0);
        Vector4::new(1.0 + phi.sum(), phi[0], phi[1], phi[2])
    }),
    // The row of vertex 0 stands last.
    wrong!(dphi_linear_tetrahedron_dX, ["wrong vertex order"], |V, element, _X| {
        let x0 = V[element[0]];
        let T = Matrix3::from_columns(&[V[element[1]] - x0, V[element[2]] - x0, V[element[3]] - x0]);
        let inv = T.try_inverse().unwrap();
        let mut dphi = Matrix4x3::<f64>::zeros();
        dphi.fixed_view_mut::<3, 3>(0, 0).copy_from(&inv);
        dphi.row_mut(3).copy_from(&-inv.row_sum());
        dphi
    }),
    // C halved as in mu / 2
    wrong!(psi_neo_hookean, ["C scaled by 0.5"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            return f64::INFINITY;
        }
        0.5 * C * (J.powf(-2.0 / 3.0) * (F.transpose() * F).trace() - 3.0) + D * (J - 1.0) * (J - 1.0)
    }),
    // The right Cauchy-Green tensor's determinant for J in the second term
    wrong!(psi_neo_hookean, ["another volume term"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            return f64::INFINITY;
        }
        let cauchy = F.transpose() * F;
        C * (J.powf(-2.0 / 3.0) * cauchy.trace() - 3.0) + D * (cauchy.determinant() - 1.0).powi(2)
    }),
    // D − 1 for J − 1
    wrong!(psi_neo_hookean, ["another material", "J for D"], |F, C, D| {
        let J = F.determinant();
        if J <= 0.0 {
            return f64::INFINITY;
        }
        C * (J.powf(-2.0 / 3.0) * (F.transpose() * F).trace() - 3.0) + D * (D - 1.0).powi(2)
    }),
    // dI/dF = F
    wrong!(dpsi_neo_hookean_dF, ["the term along F scaled by 0.5"], |F, C, D| {
        let J = F.determinant();
        let cof = F.try_inverse().unwrap().transpose() * J;
        let I = (F.transpose() * F).trace();
        let P = F * (C * J.powf(-2.0 / 3.0)) + cof * (-2.0 / 3.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0));
        rows(&P)
    }),
    // The inverse is not transposed.
    wrong!(dpsi_neo_hookean_dF, ["inverse for inverse transpose"], |F, C, D| {
        let J = F.determinant();
        let cof = F.try_inverse().unwrap() * J;
        let I = F.norm_squared();
        let P =
            F * (2.0 * C * J.powf(-2.0 / 3.0)) + cof * (-2.0 / 3.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0));
        rows(&P)
    }),
    // psi_JJ from the first derivative's power: J^(-5/3) once more
    wrong!(d2psi_neo_hookean_dF2, ["the square of the cofactors with C with another factor"], |F, C, D| {
        let J = F.determinant();
        let I = F.norm_squared();
        let f = rows(F);
        let c = rows(&(F.try_inverse().unwrap().transpose() * J));
        let psi_J = -2.0 / 3.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0);
        let psi_IJ = -2.0 / 3.0 * C * J.powf(-5.0 / 3.0);
        let psi_JJ = 10.0 / 9.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D;
        SMatrix::identity() * (2.0 * C * J.powf(-2.0 / 3.0))
            + d2J(F) * psi_J
            + (f * c.transpose() + c * f.transpose()) * (2.0 * psi_IJ)
            + c * c.transpose() * psi_JJ
    }),
    // d2I/df2 is the identity, not twice the identity
    wrong!(d2psi_neo_hookean_dF2, ["the term along the identity scaled by 0.5"], |F, C, D| {
        let J = F.determinant();
        let I = F.norm_squared();
        let f = rows(F);
        let c = rows(&(F.try_inverse().unwrap().transpose() * J));
        let psi_J = -2.0 / 3.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0);
        let psi_IJ = -2.0 / 3.0 * C * J.powf(-5.0 / 3.0);
        let psi_JJ = 10.0 / 9.0 * C * I * J.powf(-8.0 / 3.0) + 2.0 * D;
        SMatrix::identity() * (C * J.powf(-2.0 / 3.0))
            + d2J(F) * psi_J
            + (f * c.transpose() + c * f.transpose()) * (2.0 * psi_IJ)
            + c * c.transpose() * psi_JJ
    }),
    // The energy without its square
    wrong!(V_spring_particle_particle, ["not squared"], |q0, q1, l0, stiffness| {
        0.5 * stiffness * ((q1 - q0).norm() - l0)
    }),
    // The same sign on both ends
    wrong!(dV_spring_particle_particle_dq, ["the first end with the wrong sign"], |q0, q1, l0, stiffness| {
        let d = q1 - q0;
        let l = d.norm();
        if l == 0.0 {
            return SVector::zeros();
        }
        let f = d / l * stiffness * (l - l0);
        let mut out = SVector::<f64, 6>::zeros();
        out.fixed_rows_mut::<3>(0).copy_from(&f);
        out.fixed_rows_mut::<3>(3).copy_from(&f);
        out
    }),
];

fn rows(M: &Matrix3<f64>) -> SVector<f64, 9> {
    let mut v = SVector::<f64, 9>::zeros();
    for i in 0..3 {
        for j in 0..3 {
            v[3 * i + j] = M[(i, j)];
        }
    }
    v
}

fn d2J(F: &Matrix3<f64>) -> SMatrix<f64, 9, 9> {
    let r = [F.row(0).transpose(), F.row(1).transpose(), F.row(2).transpose()];
    let mut H = SMatrix::<f64, 9, 9>::zeros();
    let blocks = [(0, 1, -1.0, 2), (0, 2, 1.0, 1), (1, 0, 1.0, 2), (1, 2, -1.0, 0), (2, 0, -1.0, 1), (2, 1, 1.0, 0)];
    for (i, j, sign, k) in blocks {
        H.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&(r[k].cross_matrix() * sign));
    }
    H
}
