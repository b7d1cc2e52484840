//! Functions of one element, one deformation gradient or one spring.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3, Vector4};

use super::super::Mistake;
use super::super::by_hand::{B_matrix, by_rows, cofactors, corners, density, dphi, gradient, nodal, piola};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(phi_linear_tetrahedron, ["wrong vertex order"], |V, element, x| {
        let phi = right!(phi_linear_tetrahedron(V, element, x));
        Vector4::new(phi[0], phi[3], phi[1], phi[2])
    }),
    wrong!(phi_linear_tetrahedron, ["scaled by 1/6"], |V, element, x| right!(phi_linear_tetrahedron(V, element, x))
        / 6.0),
    wrong!(phi_linear_tetrahedron, ["clamped and summed to one", "clamped"], |V, element, x| {
        let phi = right!(phi_linear_tetrahedron(V, element, x)).map(|w| w.clamp(0.0, 1.0));
        phi / phi.sum()
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["local for global indices"], |V, _, X| right!(dphi_linear_tetrahedron_dX(
        V,
        &[0, 1, 2, 3],
        X
    ))),
    wrong!(dphi_linear_tetrahedron_dX, ["negated"], |V, element, X| -right!(dphi_linear_tetrahedron_dX(V, element, X))),
    wrong!(dphi_linear_tetrahedron_dX, ["wrong order of coordinates", "entries exchanged"], |V, element, X| {
        let D = right!(dphi_linear_tetrahedron_dX(V, element, X));
        SMatrix::from_fn(|i, j| D[(i, 2 - j)])
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["transposed for inverse"], |V, element, _| {
        let [a, b, c, d] = corners(V, element);
        let g = [b - a, c - a, d - a];
        SMatrix::from_fn(|i, j| if i == 0 { -(g[0] + g[1] + g[2])[j] } else { g[i - 1][j] })
    }),
    wrong!(T_linear_tetrahedron, ["density squared", "scaled by density"], |qdot, element, density, volume| {
        right!(T_linear_tetrahedron(qdot, element, density * density, volume))
    }),
    wrong!(T_linear_tetrahedron, ["only the first vertex", "one vertex only"], |qdot, element, density, volume| {
        0.05 * density * volume * qdot.fixed_rows::<3>(3 * element[0]).norm_squared()
    }),
    wrong!(T_linear_tetrahedron, ["negated"], |qdot, element, density, volume| -right!(T_linear_tetrahedron(
        qdot, element, density, volume
    ))),
    wrong!(
        T_linear_tetrahedron,
        ["missing the products of different velocities", "cross terms missing"],
        |qdot, element, density, volume| {
            0.05 * density * volume * element.iter().map(|&a| qdot.fixed_rows::<3>(3 * a).norm_squared()).sum::<f64>()
        }
    ),
    wrong!(quadrature_single_point, ["scaled by 6"], |V, element, volume, integrand| {
        right!(quadrature_single_point(V, element, 6.0 * volume, integrand))
    }),
    wrong!(
        quadrature_single_point,
        ["evaluated at the wrong point", "at the middle of a face"],
        |V, element, volume, integrand| {
            let [_, b, c, d] = corners(V, element);
            integrand(&((b + c + d) / 3.0)) * volume
        }
    ),
    wrong!(quadrature_single_point, ["off by one"], |V, element, volume, integrand| {
        let middle: Vector3<f64> = element.iter().map(|&a| V[(a + 1) % V.len()]).sum::<Vector3<f64>>() / 4.0;
        integrand(&middle) * volume
    }),
    wrong!(V_spring_particle_particle, ["third power"], |q0, q1, l0, k| 0.5 * k * ((q1 - q0).norm() - l0).powi(3)),
    wrong!(V_spring_particle_particle, ["only compression"], |q0, q1, l0, k| 0.5
        * k
        * ((q1 - q0).norm() - l0).min(0.0).powi(2)),
    wrong!(V_spring_particle_particle, ["square of the length"], |q0, q1, l0, k| 0.5
        * k
        * ((q1 - q0).norm_squared() - l0).powi(2)),
    wrong!(dV_spring_particle_particle_dq, ["scaled by 0.5"], |q0, q1, l0, k| right!(dV_spring_particle_particle_dq(
        q0, q1, l0, k
    )) * 0.5),
    wrong!(dV_spring_particle_particle_dq, ["only x", "only x of each end"], |q0, q1, l0, k| {
        let f = right!(dV_spring_particle_particle_dq(q0, q1, l0, k));
        SVector::from_fn(|i, _| if i % 3 == 0 { f[i] } else { 0.0 })
    }),
    wrong!(dV_spring_particle_particle_dq, ["rest length in each coordinate"], |q0, q1, l0, k| {
        let f = (q1 - q0 - Vector3::repeat(l0)) * k;
        SVector::from_fn(|i, _| if i < 3 { -f[i] } else { f[i - 3] })
    }),
    wrong!(mass_matrix_linear_tetrahedron, ["scaled by density", "density squared"], |density, volume| right!(
        mass_matrix_linear_tetrahedron(density * density, volume)
    )),
    wrong!(
        mass_matrix_linear_tetrahedron,
        ["the coupling of two vertices scaled by 0.5", "all but the diagonal scaled by 0.5"],
        |density, volume| {
            let M = right!(mass_matrix_linear_tetrahedron(density, volume));
            SMatrix::from_fn(|i, j| if i == j { M[(i, j)] } else { 0.5 * M[(i, j)] })
        }
    ),
    wrong!(
        mass_matrix_linear_tetrahedron,
        ["identity", "the same mass for all", "the diagonal scaled by 10 and missing the coupling of two vertices"],
        |density, volume| SMatrix::identity() * (density * volume)
    ),
    wrong!(psi_neo_hookean, ["negated"], |F, C, D| -right!(psi_neo_hookean(F, C, D))),
    wrong!(psi_neo_hookean, ["another volume term"], |F, C, D| density(F, |J, I| C * (J.powf(-2.0 / 3.0) * I - 3.0)
        + D * (J * J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["the term with C with the wrong sign"], |F, C, D| density(F, |J, I| C
        * (3.0 - J.powf(-2.0 / 3.0) * I)
        + D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["wrong exponent"], |F, C, D| density(F, |J, I| C * (J.powf(-3.0 / 2.0) * I - 3.0)
        + D * (J - 1.0).powi(2))),
    wrong!(psi_neo_hookean, ["power of J on both terms", "power of J on everything"], |F, C, D| density(F, |J, I| J
        .powf(-2.0 / 3.0)
        * (C * (I - 3.0) + D * (J - 1.0).powi(2)))),
    wrong!(dpsi_neo_hookean_dF, ["negated"], |F, C, D| -right!(dpsi_neo_hookean_dF(F, C, D))),
    wrong!(dpsi_neo_hookean_dF, ["missing trace"], |F, C, D| {
        let J = F.determinant();
        by_rows(
            &(F * (2.0 * C * J.powf(-2.0 / 3.0))
                + cofactors(F) * (-2.0 / 3.0 * C * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0))),
        )
    }),
    wrong!(dpsi_neo_hookean_dF, ["another material"], |F, C, D| {
        let J = F.determinant();
        by_rows(&((F - cofactors(F) / J) * (2.0 * C) + cofactors(F) * (2.0 * D * (J - 1.0))))
    }),
    wrong!(dpsi_neo_hookean_dF, ["finite differences", "inexact"], |F, C, D| {
        SVector::from_fn(|i, _| {
            let mut moved = *F;
            moved[(i / 3, i % 3)] += 1e-6;
            (right!(psi_neo_hookean(&moved, C, D)) - right!(psi_neo_hookean(F, C, D))) / 1e-6
        })
    }),
    wrong!(d2psi_neo_hookean_dF2, ["negated"], |F, C, D| -right!(d2psi_neo_hookean_dF2(F, C, D))),
    wrong!(d2psi_neo_hookean_dF2, ["missing the term with D", "D without effect"], |F, C, _| right!(
        d2psi_neo_hookean_dF2(F, C, 0.0)
    )),
    wrong!(d2psi_neo_hookean_dF2, ["only diagonal blocks"], |F, C, D| {
        let H = right!(d2psi_neo_hookean_dF2(F, C, D));
        SMatrix::from_fn(|i, j| if i / 3 == j / 3 { H[(i, j)] } else { 0.0 })
    }),
    wrong!(
        d2psi_neo_hookean_dF2,
        ["the square of the cofactors with C scaled by 1.2", "wrong factor of a term"],
        |F, C, D| {
            let (J, I) = (F.determinant(), F.norm_squared());
            let k = by_rows(&cofactors(F));
            right!(d2psi_neo_hookean_dF2(F, C, D)) + k * k.transpose() * (2.0 / 9.0 * C * I * J.powf(-8.0 / 3.0))
        }
    ),
    wrong!(V_linear_tetrahedron, ["negated"], |q, V, element, volume, C, D| -right!(V_linear_tetrahedron(
        q, V, element, volume, C, D
    ))),
    wrong!(V_linear_tetrahedron, ["FᵀF for F"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        right!(psi_neo_hookean(&(F.transpose() * F), C, D)) * volume
    }),
    wrong!(V_linear_tetrahedron, ["off by one", "other vertices in q"], |q, V, element, volume, C, D| {
        let D_X = dphi(V, element);
        let F: Matrix3<f64> = (0..4).map(|a| q.fixed_rows::<3>(3 * element[(a + 1) % 4]) * D_X.row(a)).sum();
        right!(psi_neo_hookean(&F, C, D)) * volume
    }),
    wrong!(dV_linear_tetrahedron_dq, ["missing volume"], |q, V, element, _, C, D| right!(dV_linear_tetrahedron_dq(
        q, V, element, 1.0, C, D
    ))),
    wrong!(dV_linear_tetrahedron_dq, ["Kirchhoff stress"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        nodal(&(piola(&F, C, D) * F.transpose()), &dphi(V, element), volume)
    }),
    wrong!(
        dV_linear_tetrahedron_dq,
        ["missing the second vertex", "missing second vertex"],
        |q, V, element, volume, C, D| {
            let mut f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
            f.fixed_rows_mut::<3>(3).fill(0.0);
            f
        }
    ),
    wrong!(dV_linear_tetrahedron_dq, ["symmetric part of F"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        nodal(&piola(&((F + F.transpose()) * 0.5), C, D), &dphi(V, element), volume)
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["missing volume"], |q, V, element, _, C, D| right!(
        d2V_linear_tetrahedron_dq2(q, V, element, 1.0, C, D)
    )),
    wrong!(d2V_linear_tetrahedron_dq2, ["blocks transposed"], |q, V, element, volume, C, D| {
        let H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        SMatrix::from_fn(|i, j| H[(3 * (i / 3) + j % 3, 3 * (j / 3) + i % 3)])
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["symmetric part of F"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element);
        let B = B_matrix(&dphi(V, element));
        B.transpose() * right!(d2psi_neo_hookean_dF2(&((F + F.transpose()) * 0.5), C, D)) * B * volume
    }),
    wrong!(
        d2V_linear_tetrahedron_dq2,
        ["the second derivative times the stress", "another formula"],
        |q, V, element, volume, C, D| {
            let F = gradient(q, V, element);
            let B = B_matrix(&dphi(V, element));
            let P = by_rows(&piola(&F, C, D));
            B.transpose() * (right!(d2psi_neo_hookean_dF2(&F, C, D)) + P * P.transpose() / C) * B * volume
        }
    ),
];
