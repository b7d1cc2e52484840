//! Shape functions, integrals over one element, springs and the mass of one element.

use nalgebra::{Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};

use super::super::{Mistake, by_hand::corners};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // Two of the edges have changed places.
    wrong!(phi_linear_tetrahedron, ["wrong vertex order"], |V, element, x| {
        let [a, b, c, d] = corners(V, element);
        let p = Matrix3::from_columns(&[c - a, b - a, d - a]).try_inverse().unwrap_or_default() * (x - a);
        Vector4::new(1.0 - p.sum(), p[0], p[1], p[2])
    }),
    // One sum too short.
    wrong!(
        phi_linear_tetrahedron,
        ["missing the last shape function in the sum", "the first vertex", "one vertex left out of the sum"],
        |V, element, x| {
            let phi = right!(phi_linear_tetrahedron(V, element, x));
            Vector4::new(1.0 - phi[1] - phi[2], phi[1], phi[2], phi[3])
        }
    ),
    // A sign in the cross product of the third function.
    wrong!(
        phi_linear_tetrahedron,
        ["the third vertex with the wrong sign", "wrong sign of one vertex"],
        |V, element, x| {
            let [a, b, c, d] = corners(V, element);
            let (e1, e2, e3, r) = (b - a, c - a, d - a, x - a);
            let det = e1.dot(&e2.cross(&e3));
            let (p1, p2, p3) = (r.dot(&e2.cross(&e3)) / det, r.dot(&e1.cross(&e3)) / det, r.dot(&e1.cross(&e2)) / det);
            Vector4::new(1.0 - p1 - p2 - p3, p1, p2, p3)
        }
    ),
    // Lengths instead of volumes: inverse distances to the vertices.
    wrong!(phi_linear_tetrahedron, ["inverse distances"], |V, element, x| {
        let w = Vector4::from(corners(V, element).map(|a| 1.0 / ((a - x).norm() + 1e-12)));
        w / w.sum()
    }),
    // Homogeneous coordinates with the vertices in rows.
    wrong!(phi_linear_tetrahedron, ["transposed"], |V, element, x| {
        let X = corners(V, element);
        let M = Matrix4::from_fn(|i, j| if j == 3 { 1.0 } else { X[i][j] });
        M.try_inverse().unwrap_or_default() * Vector4::new(x.x, x.y, x.z, 1.0)
    }),
    // Offset by one in the vertices of the element.
    wrong!(phi_linear_tetrahedron, ["off by one", "neighbouring vertices"], |V, element, x| {
        right!(phi_linear_tetrahedron(V, &element.map(|vertex| (vertex + 1) % V.len()), x))
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["wrong vertex order", "entries exchanged"], |V, element, X| {
        let D = right!(dphi_linear_tetrahedron_dX(V, element, X));
        Matrix4x3::from_rows(&[D.row(0), D.row(2), D.row(1), D.row(3)])
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["scaled by 1/6", "divided by six times too much"], |V, element, X| {
        right!(dphi_linear_tetrahedron_dX(V, element, X)) / 6.0
    }),
    // Gradients of unnormalised barycentric coordinates: normals of the faces.
    wrong!(dphi_linear_tetrahedron_dX, ["not divided by the volume", "missing volume"], |V, element, _| {
        let [a, b, c, d] = corners(V, element);
        let (g1, g2, g3) = ((c - a).cross(&(d - a)), (d - a).cross(&(b - a)), (b - a).cross(&(c - a)));
        Matrix4x3::from_rows(&[-(g1 + g2 + g3).transpose(), g1.transpose(), g2.transpose(), g3.transpose()])
    }),
    // The columns of the inverse for its rows.
    wrong!(dphi_linear_tetrahedron_dX, ["transposed"], |V, element, _| {
        let [a, b, c, d] = corners(V, element);
        let D = Matrix3::from_columns(&[b - a, c - a, d - a]).try_inverse().unwrap_or_default();
        let g: [Vector3<f64>; 3] = [D.column(0).into_owned(), D.column(1).into_owned(), D.column(2).into_owned()];
        Matrix4x3::from_rows(&[-(g[0] + g[1] + g[2]).transpose(), g[0].transpose(), g[1].transpose(), g[2].transpose()])
    }),
    // −1 in each coordinate, as in the unit tetrahedron.
    wrong!(dphi_linear_tetrahedron_dX, ["unit tetrahedron"], |_, _, _| {
        Matrix4x3::from_row_slice(&[-1.0, -1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])
    }),
    wrong!(dphi_linear_tetrahedron_dX, ["the last vertex with the wrong sign"], |V, element, X| {
        let mut D = right!(dphi_linear_tetrahedron_dX(V, element, X));
        D.row_mut(3).neg_mut();
        D
    }),
    wrong!(T_linear_tetrahedron, ["missing volume"], |qdot, element, density, _| {
        right!(T_linear_tetrahedron(qdot, element, density, 1.0))
    }),
    // The last vertex is forgotten in the loop.
    wrong!(T_linear_tetrahedron, ["last vertex left out", "missing last vertex"], |qdot, element, density, volume| {
        let v = SVector::<f64, 12>::from_fn(|i, _| if i < 9 { qdot[3 * element[i / 3] + i % 3] } else { 0.0 });
        0.5 * v.dot(&(right!(mass_matrix_linear_tetrahedron(density, volume)) * v))
    }),
    wrong!(T_linear_tetrahedron, ["scaled by 1/6"], |qdot, element, density, volume| {
        right!(T_linear_tetrahedron(qdot, element, density, volume / 6.0))
    }),
    // The entries of the mass matrix are 1/10 everywhere.
    wrong!(
        T_linear_tetrahedron,
        ["the products of different velocities scaled by 2"],
        |qdot, element, density, volume| {
            let v: Vector3<f64> = element.iter().map(|&a| qdot.fixed_rows::<3>(3 * a).into_owned()).sum();
            0.5 * density * volume / 10.0 * v.norm_squared()
        }
    ),
    // Velocities of the first twelve rows.
    wrong!(T_linear_tetrahedron, ["local for global indices"], |qdot, _, density, volume| {
        right!(T_linear_tetrahedron(qdot, &[0, 1, 2, 3], density, volume))
    }),
    // The momentum instead of the energy.
    wrong!(T_linear_tetrahedron, ["not squared"], |qdot, element, density, volume| {
        let v: Vector3<f64> = element.iter().map(|&a| qdot.fixed_rows::<3>(3 * a).into_owned()).sum();
        density * volume * (v / 4.0).norm()
    }),
    wrong!(
        quadrature_single_point,
        ["at a vertex", "evaluated at the wrong point"],
        |V, element, volume, integrand| { integrand(&V[element[3]]) * volume }
    ),
    wrong!(quadrature_single_point, ["scaled by 4"], |V, element, volume, integrand| {
        right!(quadrature_single_point(V, element, volume, integrand)) * 4.0
    }),
    // The sum is divided before the last vertex is added.
    wrong!(quadrature_single_point, ["evaluated at the wrong point"], |V, element, volume, integrand| {
        let [a, b, c, d] = corners(V, element);
        integrand(&((a + b + c) / 4.0 + d)) * volume
    }),
    wrong!(
        quadrature_single_point,
        ["at the vertices", "sum over the vertices", "at the vertices and scaled by 4"],
        |V, element, volume, integrand| {
            let f = corners(V, element).map(|X| integrand(&X));
            (&f[0] + &f[1] + &f[2] + &f[3]) * volume
        }
    ),
    wrong!(
        quadrature_single_point,
        ["at the middle of an edge", "evaluated at the wrong point"],
        |V, element, volume, integrand| {
            let [a, _, c, _] = corners(V, element);
            integrand(&((a + c) * 0.5)) * volume
        }
    ),
    wrong!(quadrature_single_point, ["evaluated at the wrong point"], |V, element, volume, integrand| {
        // Indices taken modulo four.
        let X: Vector3<f64> = element.iter().map(|vertex| V[vertex % 4]).sum();
        integrand(&(X / 4.0)) * volume
    }),
    wrong!(V_spring_particle_particle, ["scaled by 2"], |q0, q1, l0, k| k * ((q1 - q0).norm() - l0).powi(2)),
    wrong!(V_spring_particle_particle, ["sum of both ends"], |q0, q1, l0, k| 0.5 * k * ((q0 + q1).norm() - l0).powi(2)),
    wrong!(V_spring_particle_particle, ["relative stretch"], |q0, q1, l0, k| {
        if l0 > 0.0 { 0.5 * k * ((q1 - q0).norm() / l0 - 1.0).powi(2) } else { 0.5 * k * (q1 - q0).norm_squared() }
    }),
    wrong!(V_spring_particle_particle, ["missing the product of length and rest length"], |q0, q1, l0, k| {
        0.5 * k * ((q1 - q0).norm_squared() + l0 * l0)
    }),
    wrong!(V_spring_particle_particle, ["stiffness squared", "scaled by stiffness"], |q0, q1, l0, k| {
        0.5 * (k * ((q1 - q0).norm() - l0)).powi(2)
    }),
    wrong!(V_spring_particle_particle, ["negated"], |q0, q1, l0, k| -0.5 * k * ((q1 - q0).norm() - l0).powi(2)),
    wrong!(V_spring_particle_particle, ["z left out", "only x and y"], |q0, q1, l0, k| {
        0.5 * k * ((q1 - q0).xy().norm() - l0).powi(2)
    }),
    wrong!(dV_spring_particle_particle_dq, ["negated"], |q0, q1, l0, k| -right!(dV_spring_particle_particle_dq(
        q0, q1, l0, k
    ))),
    wrong!(dV_spring_particle_particle_dq, ["missing stiffness"], |q0, q1, l0, _| right!(
        dV_spring_particle_particle_dq(q0, q1, l0, 1.0)
    )),
    wrong!(dV_spring_particle_particle_dq, ["NaN in a limiting case", "NaN at zero length"], |q0, q1, l0, k| {
        halves((q1 - q0).normalize() * (k * ((q1 - q0).norm() - l0)))
    }),
    // The direction alone, without the stretch.
    wrong!(dV_spring_particle_particle_dq, ["unit direction alone", "missing stretch"], |q0, q1, _, k| {
        halves((q1 - q0).try_normalize(0.0).unwrap_or_default() * k)
    }),
    wrong!(
        dV_spring_particle_particle_dq,
        [
            "rest length with the wrong sign",
            "the rest length on the first end with the wrong sign and the rest length on the second end with the wrong sign"
        ],
        |q0, q1, l0, k| {
            let d = q1 - q0;
            halves(d.try_normalize(0.0).unwrap_or_default() * (k * (d.norm() + l0)))
        }
    ),
    wrong!(dV_spring_particle_particle_dq, ["wrong order of coordinates", "grouped by coordinate"], |q0, q1, l0, k| {
        let f = right!(dV_spring_particle_particle_dq(q0, q1, l0, k));
        SVector::from_fn(|i, _| f[3 * (i % 2) + i / 2])
    }),
    wrong!(
        dV_spring_particle_particle_dq,
        ["stretch squared", "not differentiated", "not differentiated and scaled by 0.5"],
        |q0, q1, l0, k| {
            let d = q1 - q0;
            halves(d.try_normalize(0.0).unwrap_or_default() * (0.5 * k * (d.norm() - l0).powi(2)))
        }
    ),
    wrong!(mass_matrix_linear_tetrahedron, ["missing density"], |_, volume| right!(mass_matrix_linear_tetrahedron(
        1.0, volume
    ))),
    wrong!(mass_matrix_linear_tetrahedron, ["missing volume"], |density, _| right!(mass_matrix_linear_tetrahedron(
        density, 1.0
    ))),
    wrong!(mass_matrix_linear_tetrahedron, ["scaled by 2"], |density, volume| right!(mass_matrix_linear_tetrahedron(
        density, volume
    )) * 2.0),
    // Only x carries mass.
    wrong!(mass_matrix_linear_tetrahedron, ["only entries along x"], |density, volume| {
        SMatrix::from_fn(|i, j| match (i % 3 + j % 3, i / 3 == j / 3) {
            (0, true) => density * volume / 10.0,
            (0, false) => density * volume / 20.0,
            _ => 0.0,
        })
    }),
    wrong!(mass_matrix_linear_tetrahedron, ["only diagonal"], |density, volume| SMatrix::identity()
        * (density * volume / 10.0)),
    wrong!(
        mass_matrix_linear_tetrahedron,
        ["the coupling of two vertices with the wrong sign", "all but the diagonal with the wrong sign"],
        |density, volume| {
            let M = right!(mass_matrix_linear_tetrahedron(density, volume));
            SMatrix::from_fn(|i, j| if i == j { M[(i, j)] } else { -M[(i, j)] })
        }
    ),
];

fn halves(on_q1: Vector3<f64>) -> SVector<f64, 6> {
    SVector::from_fn(|i, _| if i < 3 { -on_q1[i] } else { on_q1[i - 3] })
}
