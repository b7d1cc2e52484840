//! Energy, gradient and Hessian of one elastic element.

use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

use super::super::Mistake;
use super::super::by_hand::{B_matrix, by_columns, dphi, gradient, nodal, piola};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(V_linear_tetrahedron, ["scaled by 1/6"], |q, V, element, volume, C, D| {
        right!(V_linear_tetrahedron(q, V, element, volume, C, D)) / 6.0
    }),
    wrong!(V_linear_tetrahedron, ["identity added to F"], |q, V, element, volume, C, D| {
        right!(psi_neo_hookean(&(gradient(q, V, element) + Matrix3::identity()), C, D)) * volume
    }),
    wrong!(V_linear_tetrahedron, ["factor 3 left out in q"], |q, V, element, volume, C, D| {
        let x = SVector::<f64, 12>::from_fn(|i, _| q[element[i / 3] + i % 3]);
        let F: Matrix3<f64> = (0..4).map(|a| x.fixed_rows::<3>(3 * a) * dphi(V, element).row(a)).sum();
        right!(psi_neo_hookean(&F, C, D)) * volume
    }),
    wrong!(V_linear_tetrahedron, ["sorted vertices in q"], |q, V, element, volume, C, D| {
        let mut sorted = *element;
        sorted.sort_unstable();
        let D_X = dphi(V, element);
        let F: Matrix3<f64> = (0..4).map(|a| q.fixed_rows::<3>(3 * sorted[a]) * D_X.row(a)).sum();
        right!(psi_neo_hookean(&F, C, D)) * volume
    }),
    wrong!(V_linear_tetrahedron, ["zero", "deformed for rest"], |q, V, element, volume, C, D| {
        let x: Vec<Vector3<f64>> = (0..V.len()).map(|a| q.fixed_rows::<3>(3 * a).into_owned()).collect();
        right!(V_linear_tetrahedron(q, &x, element, volume, C, D))
    }),
    wrong!(V_linear_tetrahedron, ["deformed volume"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        right!(psi_neo_hookean(&F, C, D)) * volume * F.determinant()
    }),
    wrong!(V_linear_tetrahedron, ["symmetric part of F"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        right!(psi_neo_hookean(&((F + F.transpose()) * 0.5), C, D)) * volume
    }),
    wrong!(dV_linear_tetrahedron_dq, ["transposed"], |q, V, element, volume, C, D| {
        let P = piola(&gradient(q, V, element), C, D);
        nodal(&P.transpose(), &dphi(V, element), volume)
    }),
    wrong!(dV_linear_tetrahedron_dq, ["transposed"], |q, V, element, volume, C, D| {
        let P = piola(&gradient(q, V, element).transpose(), C, D);
        nodal(&P, &dphi(V, element), volume)
    }),
    wrong!(dV_linear_tetrahedron_dq, ["missing term"], |q, V, element, volume, C, D| {
        let mut f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        f.fixed_rows_mut::<3>(0).fill(0.0);
        f
    }),
    wrong!(dV_linear_tetrahedron_dq, ["Cauchy stress"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        let sigma = piola(&F, C, D) * F.transpose() / F.determinant();
        nodal(&sigma, &dphi(V, element), volume)
    }),
    wrong!(dV_linear_tetrahedron_dq, ["scaled by 0.5"], |q, V, element, volume, C, D| {
        right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D)) * 0.5
    }),
    wrong!(dV_linear_tetrahedron_dq, ["wrong vertex order"], |q, V, element, volume, C, D| {
        let f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        SVector::from_fn(|i, _| f[3 * (3 - i / 3) + i % 3])
    }),
    wrong!(dV_linear_tetrahedron_dq, ["only x of each vertex"], |q, V, element, volume, C, D| {
        let f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        SVector::from_fn(|i, _| if i % 3 == 0 { f[i] } else { 0.0 })
    }),
    wrong!(dV_linear_tetrahedron_dq, ["the first vertex with the wrong sign"], |q, V, element, volume, C, D| {
        let mut f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        let sum: Vector3<f64> = (1..4).map(|a| f.fixed_rows::<3>(3 * a).into_owned()).sum();
        f.fixed_rows_mut::<3>(0).copy_from(&sum);
        f
    }),
    wrong!(dV_linear_tetrahedron_dq, ["second Piola–Kirchhoff stress"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        let S = F.try_inverse().unwrap_or_default() * piola(&F, C, D);
        nodal(&S, &dphi(V, element), volume)
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["only upper triangle"], |q, V, element, volume, C, D| {
        let H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        SMatrix::from_fn(|i, j| if i <= j { H[(i, j)] } else { 0.0 })
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["blocks transposed"], |q, V, element, volume, C, D| {
        let H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        SMatrix::from_fn(|i, j| H[(3 * (i / 3) + j % 3, 3 * (j / 3) + i % 3)])
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["scaled by volume"], |q, V, element, volume, C, D| {
        right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D)) * volume
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["missing first vertex"], |q, V, element, volume, C, D| {
        let mut H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        H.rows_mut(0, 3).fill(0.0);
        H.columns_mut(0, 3).fill(0.0);
        H
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["only entries between equal coordinates"], |q, V, element, volume, C, D| {
        let H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        SMatrix::from_fn(|i, j| if i % 3 == j % 3 { H[(i, j)] } else { 0.0 })
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["columns for rows"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        let H = right!(d2psi_neo_hookean_dF2(&F.transpose(), C, D));
        let B = B_matrix(&dphi(V, element));
        B.transpose() * H * B * volume
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["projected after the minus"], |q, V, element, volume, C, D| {
        let H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        let negative = -H;
        crate_project(&negative)
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["finite differences"], |q, V, element, volume, C, D| {
        // The gradient of the force in a loop over finite differences with too large a step.
        let h = 1e-3;
        let f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        let mut H = SMatrix::<f64, 12, 12>::zeros();
        for j in 0..12 {
            let mut moved: DVector<f64> = q.clone();
            moved[3 * element[j / 3] + j % 3] += h;
            H.set_column(j, &((right!(dV_linear_tetrahedron_dq(&moved, V, element, volume, C, D)) - f) / h));
        }
        H
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["product of the gradient with itself"], |q, V, element, volume, C, D| {
        // The outer product of the gradient with itself.
        let P = by_columns(&piola(&gradient(q, V, element), C, D).transpose());
        let B = B_matrix(&dphi(V, element));
        B.transpose() * P * P.transpose() * B * volume
    }),
];

fn crate_project(H: &SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12> {
    finite_elements_3d::given::project(H)
}
