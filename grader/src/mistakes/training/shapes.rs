//! Shape functions, integrals over one element, springs and the mass of one element.

use nalgebra::{Matrix3, Matrix4x3, SMatrix, SVector, Vector3, Vector4};

use super::super::{Mistake, by_hand::corners};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(phi_linear_tetrahedron, ["first shape function is one"], |V, element, x| {
        let mut phi = right!(phi_linear_tetrahedron(V, element, x));
        phi[0] = 1.0;
        phi
    }),
    wrong!(phi_linear_tetrahedron, ["barycentric sign"], |V, element, x| {
        let mut phi = right!(phi_linear_tetrahedron(V, element, x));
        phi[0] = -phi[0];
        phi
    }),
    wrong!(phi_linear_tetrahedron, ["measured from another vertex"], |V, element, x| phi_from(
        V,
        element,
        &(x - V[element[1]])
    )),
    wrong!(phi_linear_tetrahedron, ["point taken for an offset"], |V, element, x| phi_from(V, element, x)),
    wrong!(phi_linear_tetrahedron, ["unsigned volumes"], |V, element, x| right!(phi_linear_tetrahedron(V, element, x))
        .abs()),
    wrong!(phi_linear_tetrahedron, ["sorted vertices"], |V, element, x| {
        let phi = right!(phi_linear_tetrahedron(V, element, x));
        let mut sorted = *element;
        sorted.sort_unstable();
        Vector4::from_fn(|i, _| phi[element.iter().position(|&v| v == sorted[i]).unwrap_or(0)])
    }),
    wrong!(phi_linear_tetrahedron, ["divided by the volume for six times the volume"], |V, element, x| {
        let phi = right!(phi_linear_tetrahedron(V, element, x)) * 6.0;
        Vector4::new(1.0 - phi[1] - phi[2] - phi[3], phi[1], phi[2], phi[3])
    }),
    wrong!(phi_linear_tetrahedron, ["transposed"], |V, element, x| {
        let [a, b, c, d] = corners(V, element);
        let T = Matrix3::from_columns(&[b - a, c - a, d - a]).transpose();
        let p = T.try_inverse().unwrap_or_default() * (x - a);
        Vector4::new(1.0 - p.sum(), p[0], p[1], p[2])
    }),
    wrong!(phi_linear_tetrahedron, ["edges one after the other"], |V, element, x| {
        let [a, b, c, d] = corners(V, element);
        let T = Matrix3::from_columns(&[b - a, c - b, d - c]);
        let p = T.try_inverse().unwrap_or_default() * (x - a);
        Vector4::new(1.0 - p.sum(), p[0], p[1], p[2])
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["missing term"], |V, element, X| {
        let mut D = right!(dphi_linear_tetrahedron_dX(V, element, X));
        D.row_mut(0).fill(0.0);
        D
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["barycentric sign"], |V, element, X| {
        let mut D = right!(dphi_linear_tetrahedron_dX(V, element, X));
        D.row_mut(0).neg_mut();
        D
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["transposed"], |V, element, _| {
        let [a, b, c, d] = corners(V, element);
        gradients(&Matrix3::from_columns(&[b - a, c - a, d - a]).transpose())
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["edges from the point"], |V, element, X| {
        let [_, b, c, d] = corners(V, element);
        gradients(&Matrix3::from_columns(&[b - X, c - X, d - X]))
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["unsigned volume"], |V, element, X| {
        let D = right!(dphi_linear_tetrahedron_dX(V, element, X));
        let [a, b, c, d] = corners(V, element);
        D * (b - a).dot(&(c - a).cross(&(d - a))).signum()
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["missing volume"], |V, element, X| {
        let [a, b, c, d] = corners(V, element);
        right!(dphi_linear_tetrahedron_dX(V, element, X)) * (b - a).dot(&(c - a).cross(&(d - a)))
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["first vertex from one other alone"], |V, element, X| {
        let mut D = right!(dphi_linear_tetrahedron_dX(V, element, X));
        let g1 = D.row(1).into_owned();
        D.set_row(0, &-g1);
        D
    }),
    wrong!(T_linear_tetrahedron, ["scaled by 2"], |qdot, element, density, volume| {
        right!(T_linear_tetrahedron(qdot, element, density, volume)) * 2.0
    }),
    wrong!(T_linear_tetrahedron, ["lumped"], |qdot, element, density, volume| {
        let sum: f64 = element.iter().map(|&a| qdot.fixed_rows::<3>(3 * a).norm_squared()).sum();
        0.5 * density * volume * sum / 4.0
    }),
    wrong!(T_linear_tetrahedron, ["only the centroid"], |qdot, element, density, volume| {
        let mean: Vector3<f64> = element.iter().map(|&a| qdot.fixed_rows::<3>(3 * a).into_owned()).sum();
        0.5 * density * volume * (mean / 4.0).norm_squared()
    }),
    wrong!(
        T_linear_tetrahedron,
        ["missing the velocity along y and missing the velocity along z", "only x"],
        |qdot, element, density, volume| {
            let mut x_only = qdot.clone();
            x_only.iter_mut().enumerate().for_each(|(i, v)| {
                if i % 3 != 0 {
                    *v = 0.0
                }
            });
            right!(T_linear_tetrahedron(&x_only, element, density, volume))
        }
    ),
    wrong!(T_linear_tetrahedron, ["factor 3 left out in q"], |qdot, element, density, volume| {
        let v = SVector::<f64, 12>::from_fn(|i, _| qdot[element[i / 3] + i % 3]);
        0.5 * v.dot(&(right!(mass_matrix_linear_tetrahedron(density, volume)) * v))
    }),
    wrong!(T_linear_tetrahedron, ["scaled by density"], |qdot, element, density, volume| {
        right!(T_linear_tetrahedron(qdot, element, density, volume)) * density
    }),
    wrong!(T_linear_tetrahedron, ["the squares of the velocities scaled by 0.5"], |qdot, element, density, volume| {
        let v = |a: usize| qdot.fixed_rows::<3>(3 * element[a]).into_owned();
        let sum: f64 = (0..16).map(|k| v(k / 4).dot(&v(k % 4))).sum();
        0.5 * density * volume / 20.0 * sum
    }),
    wrong!(quadrature_single_point, ["at the vertices"], |V, element, volume, integrand| {
        let all = element.map(|vertex| integrand(&V[vertex]));
        (&all[0] + &all[1] + &all[2] + &all[3]) * (volume / 4.0)
    }),
    wrong!(quadrature_single_point, ["at the origin"], |_, _, volume, integrand| integrand(&Vector3::zeros()) * volume),
    wrong!(quadrature_single_point, ["mean of all vertices"], |V, _, volume, integrand| {
        integrand(&(V.iter().sum::<Vector3<f64>>() / V.len() as f64)) * volume
    }),
    wrong!(quadrature_single_point, ["divided by 3"], |V, element, volume, integrand| {
        integrand(&(corners(V, element).iter().sum::<Vector3<f64>>() / 3.0)) * volume
    }),
    wrong!(quadrature_single_point, ["at the middle of a face"], |V, element, volume, integrand| {
        integrand(&(corners(V, element)[..3].iter().sum::<Vector3<f64>>() / 3.0)) * volume
    }),
    wrong!(quadrature_single_point, ["scaled by 0.25"], |V, element, volume, integrand| {
        right!(quadrature_single_point(V, element, volume, integrand)) / 4.0
    }),
    wrong!(quadrature_single_point, ["scaled by volume"], |V, element, volume, integrand| {
        right!(quadrature_single_point(V, element, volume * volume, integrand))
    }),
    wrong!(V_spring_particle_particle, ["difference of squares"], |q0, q1, l0, k| 0.5
        * k
        * ((q1 - q0).norm_squared() - l0 * l0)),
    wrong!(V_spring_particle_particle, ["squared lengths"], |q0, q1, l0, k| 0.5
        * k
        * ((q1 - q0).norm_squared() - l0 * l0).powi(2)),
    wrong!(V_spring_particle_particle, ["missing rest length"], |q0, q1, _, k| 0.5 * k * (q1 - q0).norm_squared()),
    wrong!(V_spring_particle_particle, ["only under tension"], |q0, q1, l0, k| 0.5
        * k
        * ((q1 - q0).norm() - l0).max(0.0).powi(2)),
    wrong!(V_spring_particle_particle, ["distances from the origin"], |q0, q1, l0, k| 0.5
        * k
        * (q1.norm() - q0.norm() - l0).powi(2)),
    wrong!(V_spring_particle_particle, ["not squared"], |q0, q1, l0, k| 0.5 * k * ((q1 - q0).norm() - l0)),
    wrong!(V_spring_particle_particle, ["rest length with the wrong sign"], |q0, q1, l0, k| 0.5
        * k
        * ((q1 - q0).norm() + l0).powi(2)),
    wrong!(V_spring_particle_particle, ["missing stiffness"], |q0, q1, l0, _| 0.5 * ((q1 - q0).norm() - l0).powi(2)),
    wrong!(dV_spring_particle_particle_dq, ["direction not normalised"], |q0, q1, l0, k| {
        spring((q1 - q0) * (k * ((q1 - q0).norm() - l0)), -1.0)
    }),
    wrong!(dV_spring_particle_particle_dq, ["one end only"], |q0, q1, l0, k| {
        let f = right!(dV_spring_particle_particle_dq(q0, q1, l0, k));
        SVector::from_fn(|i, _| if i < 3 { 0.0 } else { f[i] })
    }),
    wrong!(dV_spring_particle_particle_dq, ["the first end with the wrong sign"], |q0, q1, l0, k| {
        let f = right!(dV_spring_particle_particle_dq(q0, q1, l0, k));
        SVector::from_fn(|i, _| f[3 + i % 3])
    }),
    wrong!(dV_spring_particle_particle_dq, ["missing rest length"], |q0, q1, _, k| spring((q1 - q0) * k, -1.0)),
    wrong!(dV_spring_particle_particle_dq, ["direction divided by the rest length"], |q0, q1, l0, k| {
        let d = q1 - q0;
        let stretch = if l0 > 0.0 { 1.0 - d.norm() / l0 } else { 0.0 };
        spring(d * (-k * stretch), -1.0)
    }),
    wrong!(dV_spring_particle_particle_dq, ["scaled by 2"], |q0, q1, l0, k| {
        right!(dV_spring_particle_particle_dq(q0, q1, l0, k)) * 2.0
    }),
    wrong!(dV_spring_particle_particle_dq, ["only tension"], |q0, q1, l0, k| {
        if (q1 - q0).norm() < l0 { SVector::zeros() } else { right!(dV_spring_particle_particle_dq(q0, q1, l0, k)) }
    }),
    wrong!(mass_matrix_linear_tetrahedron, ["lumped"], |density, volume| SMatrix::identity()
        * (density * volume / 4.0)),
    wrong!(
        mass_matrix_linear_tetrahedron,
        ["coordinates not kept apart and the diagonal scaled by 0.5"],
        |density, volume| SMatrix::from_element(density * volume / 20.0)
    ),
    wrong!(
        mass_matrix_linear_tetrahedron,
        [
            "additional the coupling of a vertex's coordinates and additional the coupling of different coordinates of two vertices"
        ],
        |density, volume| { SMatrix::from_fn(|i, j| density * volume / if i == j { 10.0 } else { 20.0 }) }
    ),
    wrong!(mass_matrix_linear_tetrahedron, ["the diagonal scaled by 0.5"], |density, volume| {
        SMatrix::from_fn(|i, j| if i % 3 == j % 3 { density * volume / 20.0 } else { 0.0 })
    }),
    wrong!(mass_matrix_linear_tetrahedron, ["grouped by coordinate"], |density, volume| {
        SMatrix::from_fn(|i, j| if i / 4 == j / 4 { density * volume / if i == j { 10.0 } else { 20.0 } } else { 0.0 })
    }),
    wrong!(mass_matrix_linear_tetrahedron, ["only upper triangle"], |density, volume| {
        let M = right!(mass_matrix_linear_tetrahedron(density, volume));
        SMatrix::from_fn(|i, j| if i <= j { M[(i, j)] } else { 0.0 })
    }),
    wrong!(mass_matrix_linear_tetrahedron, ["scaled by 1/6"], |density, volume| {
        right!(mass_matrix_linear_tetrahedron(density, volume)) / 6.0
    }),
];

/// The shape functions where the last three are those of this vector.
fn phi_from(V: &[Vector3<f64>], element: &[usize; 4], r: &Vector3<f64>) -> Vector4<f64> {
    let [a, b, c, d] = corners(V, element);
    let p = Matrix3::from_columns(&[b - a, c - a, d - a]).try_inverse().unwrap_or_default() * r;
    Vector4::new(1.0 - p.sum(), p[0], p[1], p[2])
}

/// The gradients of the shape functions by the inverse of a matrix of edges.
fn gradients(edges: &Matrix3<f64>) -> Matrix4x3<f64> {
    let inverse = edges.try_inverse().unwrap_or_default();
    let first = -inverse.row_sum();
    Matrix4x3::from_rows(&[
        first,
        inverse.row(0).into_owned(),
        inverse.row(1).into_owned(),
        inverse.row(2).into_owned(),
    ])
}

fn spring(on_q1: Vector3<f64>, sign: f64) -> SVector<f64, 6> {
    SVector::from_fn(|i, _| if i < 3 { sign * on_q1[i] } else { on_q1[i - 3] })
}
