//! Energy, gradient and Hessian of one elastic element.

use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

use super::super::Mistake;
use super::super::by_hand::{B_matrix, dphi, gradient, nodal, piola};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(V_linear_tetrahedron, ["scaled by volume", "volume squared"], |q, V, element, volume, C, D| {
        right!(V_linear_tetrahedron(q, V, element, volume * volume, C, D))
    }),
    wrong!(V_linear_tetrahedron, ["C and D swapped"], |q, V, element, volume, C, D| right!(V_linear_tetrahedron(
        q, V, element, volume, D, C
    ))),
    wrong!(V_linear_tetrahedron, ["local for global indices in q"], |q, V, element, volume, C, D| {
        let D_X = dphi(V, element);
        let F: Matrix3<f64> = (0..4).map(|a| q.fixed_rows::<3>(3 * a) * D_X.row(a)).sum();
        right!(psi_neo_hookean(&F, C, D)) * volume
    }),
    // Only the displacement of the vertices from the first one is multiplied.
    wrong!(V_linear_tetrahedron, ["first shape function left out"], |q, V, element, volume, C, D| {
        let D_X = dphi(V, element);
        let F: Matrix3<f64> = (1..4).map(|a| q.fixed_rows::<3>(3 * element[a]) * D_X.row(a)).sum();
        right!(psi_neo_hookean(&F, C, D)) * volume
    }),
    wrong!(V_linear_tetrahedron, ["computes the volume anew", "volume with a sign"], |q, V, element, _, C, D| {
        let [a, b, c, d] = element.map(|vertex| V[vertex]);
        let own = (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0;
        right!(V_linear_tetrahedron(q, V, element, own, C, D))
    }),
    wrong!(V_linear_tetrahedron, ["inverse of F", "rest and deformed swapped"], |q, V, element, volume, C, D| {
        let F = gradient(q, V, element).try_inverse().unwrap_or_default();
        right!(psi_neo_hookean(&F, C, D)) * volume
    }),
    wrong!(V_linear_tetrahedron, ["zero outside the unit volume", "missing volume"], |q, V, element, _, C, D| {
        right!(psi_neo_hookean(&gradient(q, V, element), C, D))
    }),
    wrong!(dV_linear_tetrahedron_dq, ["negated"], |q, V, element, volume, C, D| -right!(dV_linear_tetrahedron_dq(
        q, V, element, volume, C, D
    ))),
    wrong!(dV_linear_tetrahedron_dq, ["grouped by coordinate"], |q, V, element, volume, C, D| {
        let f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        SVector::from_fn(|i, _| f[3 * (i % 4) + i / 4])
    }),
    wrong!(dV_linear_tetrahedron_dq, ["gradients in the deformed body"], |q, V, element, volume, C, D| {
        let x: Vec<Vector3<f64>> = (0..V.len()).map(|a| q.fixed_rows::<3>(3 * a).into_owned()).collect();
        nodal(&piola(&gradient(q, V, element), C, D), &dphi(&x, element), volume)
    }),
    wrong!(dV_linear_tetrahedron_dq, ["symmetric part of the stress"], |q, V, element, volume, C, D| {
        let P = piola(&gradient(q, V, element), C, D);
        nodal(&((P + P.transpose()) * 0.5), &dphi(V, element), volume)
    }),
    wrong!(dV_linear_tetrahedron_dq, ["missing last vertex"], |q, V, element, volume, C, D| {
        let mut f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        f.fixed_rows_mut::<3>(9).fill(0.0);
        f
    }),
    wrong!(dV_linear_tetrahedron_dq, ["wrong order of coordinates"], |q, V, element, volume, C, D| {
        let f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        SVector::from_fn(|i, _| f[3 * (i / 3) + (i + 1) % 3])
    }),
    // The force of the rest state is subtracted twice, so half of the vertices are doubled.
    wrong!(dV_linear_tetrahedron_dq, ["the first half scaled by 2"], |q, V, element, volume, C, D| {
        let f = right!(dV_linear_tetrahedron_dq(q, V, element, volume, C, D));
        SVector::from_fn(|i, _| if i < 6 { 2.0 * f[i] } else { f[i] })
    }),
    wrong!(dV_linear_tetrahedron_dq, ["identity added to F"], |q, V, element, volume, C, D| {
        let u = DVector::from_fn(q.len(), |i, _| q[i] - V[i / 3][i % 3]);
        nodal(&piola(&(gradient(&u, V, element) + Matrix3::identity() * 2.0), C, D), &dphi(V, element), volume)
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["scaled by 0.5"], |q, V, element, volume, C, D| right!(
        d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D)
    ) * 0.5),
    wrong!(d2V_linear_tetrahedron_dq2, ["C and D swapped"], |q, V, element, volume, C, D| right!(
        d2V_linear_tetrahedron_dq2(q, V, element, volume, D, C)
    )),
    wrong!(d2V_linear_tetrahedron_dq2, ["only diagonal"], |q, V, element, volume, C, D| {
        let H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        SMatrix::from_fn(|i, j| if i == j { H[(i, j)] } else { 0.0 })
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["wrong vertex order"], |q, V, element, volume, C, D| {
        let H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
        let at = |i: usize| 3 * (3 - i / 3) + i % 3;
        SMatrix::from_fn(|i, j| H[(at(i), at(j))])
    }),
    // Without the geometric part: the stiffness of F = 1 carried along.
    wrong!(d2V_linear_tetrahedron_dq2, ["rest for deformed"], |q, V, element, volume, C, D| {
        let _ = q;
        let B = B_matrix(&dphi(V, element));
        B.transpose() * right!(d2psi_neo_hookean_dF2(&Matrix3::identity(), C, D)) * B * volume
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["absolute eigenvalues"], |q, V, element, volume, C, D| {
        let mut eigen = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D)).symmetric_eigen();
        eigen.eigenvalues.apply(|value| *value = value.abs());
        eigen.recompose()
    }),
    wrong!(d2V_linear_tetrahedron_dq2, ["unit gradients"], |q, V, element, volume, C, D| {
        let mut D_X = dphi(V, element);
        let H = right!(d2psi_neo_hookean_dF2(&gradient(q, V, element), C, D));
        D_X.row_iter_mut().for_each(|mut row| {
            row.normalize_mut();
        });
        let B = B_matrix(&D_X);
        B.transpose() * H * B * volume
    }),
    wrong!(
        d2V_linear_tetrahedron_dq2,
        ["missing first vertex", "missing block of the first vertex"],
        |q, V, element, volume, C, D| {
            let mut H = right!(d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D));
            H.fixed_view_mut::<3, 3>(0, 0).fill(0.0);
            H
        }
    ),
];
