//! Functions of one element.

use finite_elements_3d as solved;
use finite_elements_3d::given::deformation_gradient;
use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // The matrix of the page, without the one half
    wrong!(T_linear_tetrahedron, ["scaled by 2"], |qdot, element, density, volume| {
        let v = SVector::<f64, 12>::from_fn(|k, _| qdot[3 * element[k / 3] + k % 3]);
        (v.transpose() * solved::mass_matrix_linear_tetrahedron(density, volume) * v)[0]
    }),
    // The mean velocity of the vertices
    wrong!(T_linear_tetrahedron, ["only the centroid"], |qdot, element, density, volume| {
        let mut v = Vector3::zeros();
        for i in 0..4 {
            v += qdot.fixed_rows::<3>(3 * element[i]) / 4.0;
        }
        0.5 * density * volume * v.dot(&v)
    }),
    // The mean of the integrand at the four vertices
    wrong!(quadrature_single_point, ["at the vertices"], |V, element, volume, integrand| {
        let mut sum = integrand(&V[element[0]]);
        for i in 1..4 {
            sum += integrand(&V[element[i]]);
        }
        sum * (volume / 4.0)
    }),
    // Never divided by four
    wrong!(quadrature_single_point, ["sum for mean"], |V, element, volume, integrand| {
        integrand(&(V[element[0]] + V[element[1]] + V[element[2]] + V[element[3]])) * volume
    }),
    // q read as if x, y and z of all vertices stood apart
    wrong!(V_linear_tetrahedron, ["coordinates apart in q"], |q, V, element, volume, C, D| {
        let n = V.len();
        let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
        let mut F = Matrix3::zeros();
        for i in 0..4 {
            let x = Vector3::new(q[element[i]], q[n + element[i]], q[2 * n + element[i]]);
            F += x * dphi.row(i);
        }
        solved::psi_neo_hookean(&F, C, D) * volume
    }),
    // One sixth of the determinant of the edges, with its sign, for the volume
    wrong!(V_linear_tetrahedron, ["volume with a sign", "computes the volume anew"], |q, V, element, _volume, C, D| {
        let X = element.map(|i| V[i]);
        let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &X[0]);
        let F = deformation_gradient(q, element, &dphi);
        let volume = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]).determinant() / 6.0;
        volume * solved::psi_neo_hookean(&F, C, D)
    }),
    // B with the coordinates of a vertex and the columns of F exchanged
    wrong!(dV_linear_tetrahedron_dq, ["transposed", "columns for rows"], |q, V, element, volume, C, D| {
        let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
        let F = deformation_gradient(q, element, &dphi);
        let mut B = SMatrix::<f64, 9, 12>::zeros();
        for i in 0..4 {
            for a in 0..3 {
                for b in 0..3 {
                    B[(a + 3 * b, 3 * i + a)] = dphi[(i, b)];
                }
            }
        }
        B.transpose() * solved::dpsi_neo_hookean_dF(&F, C, D) * volume
    }),
    // Forces, and no volume
    wrong!(dV_linear_tetrahedron_dq, ["missing volume and negated"], |q, V, element, _volume, C, D| {
        -solved::dV_linear_tetrahedron_dq(q, V, element, 1.0, C, D)
    }),
    // The symmetric part, "to be safe", of B^T H B with a wrong B
    wrong!(d2V_linear_tetrahedron_dq2, ["columns for rows"], |q, V, element, volume, C, D| {
        let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
        let F = deformation_gradient(q, element, &dphi);
        let mut B = SMatrix::<f64, 9, 12>::zeros();
        for i in 0..4 {
            for a in 0..3 {
                for b in 0..3 {
                    B[(a + 3 * b, 3 * i + a)] = dphi[(i, b)];
                }
            }
        }
        B.transpose() * solved::d2psi_neo_hookean_dF2(&F, C, D) * B * volume
    }),
    // The Hessian at the undeformed positions
    wrong!(d2V_linear_tetrahedron_dq2, ["rest for deformed"], |_q, V, element, volume, C, D| {
        let mut q = DVector::zeros(3 * V.len());
        for (i, X) in V.iter().enumerate() {
            q.fixed_rows_mut::<3>(3 * i).copy_from(X);
        }
        solved::d2V_linear_tetrahedron_dq2(&q, V, element, volume, C, D)
    }),
    // The factor 6 of the formula is forgotten.
    wrong!(mass_matrix_linear_tetrahedron, ["scaled by 1/6"], |density, volume| {
        let mut M = SMatrix::<f64, 12, 12>::zeros();
        for i in 0..4 {
            for j in 0..4 {
                let m = density * volume * if i == j { 1.0 / 60.0 } else { 1.0 / 120.0 };
                for k in 0..3 {
                    M[(3 * i + k, 3 * j + k)] = m;
                }
            }
        }
        M
    }),
];
