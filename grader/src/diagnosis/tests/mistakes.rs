//! Known mistakes, each with the name that it must be given.

use finite_elements_3d as solved;
use grader_child::Functions;
use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

use crate::reference::REFERENCE;

/// Function, a table with the mistake in it, its name.
pub type Mistake = (&'static str, Functions, &'static str);

fn by_columns(order: usize) -> usize {
    3 * (order % 3) + order / 3
}

pub const ELEMENTS: &[Mistake] = &[
    (
        "phi_linear_tetrahedron",
        Functions {
            phi_linear_tetrahedron: |V, e, x| solved::phi_linear_tetrahedron(V, &[e[1], e[0], e[2], e[3]], x),
            ..REFERENCE
        },
        "wrong vertex order",
    ),
    (
        "dphi_linear_tetrahedron_dX",
        Functions {
            dphi_linear_tetrahedron_dX: |V, e, _| {
                let T = Matrix3::from_columns(&[V[e[1]] - V[e[0]], V[e[2]] - V[e[0]], V[e[3]] - V[e[0]]]);
                let D = T.try_inverse().unwrap_or_default().transpose();
                nalgebra::Matrix4x3::from_fn(|i, j| if i == 0 { -D.column(j).sum() } else { D[(i - 1, j)] })
            },
            ..REFERENCE
        },
        "transposed",
    ),
    (
        "psi_neo_hookean",
        Functions { psi_neo_hookean: |F, C, D| solved::psi_neo_hookean(F, D, C), ..REFERENCE },
        "C and D swapped",
    ),
    (
        "psi_neo_hookean",
        Functions { psi_neo_hookean: |F, C, D| 0.5 * solved::psi_neo_hookean(F, C, D), ..REFERENCE },
        "scaled by 0.5",
    ),
    (
        "dpsi_neo_hookean_dF",
        Functions { dpsi_neo_hookean_dF: |F, C, D| -solved::dpsi_neo_hookean_dF(F, C, D), ..REFERENCE },
        "negated",
    ),
    (
        "dpsi_neo_hookean_dF",
        Functions {
            dpsi_neo_hookean_dF: |F, C, D| {
                let P = solved::dpsi_neo_hookean_dF(F, C, D);
                SVector::from_fn(|k, _| P[by_columns(k)])
            },
            ..REFERENCE
        },
        "columns for rows",
    ),
    (
        "d2psi_neo_hookean_dF2",
        Functions {
            d2psi_neo_hookean_dF2: |F, C, D| {
                let H = solved::d2psi_neo_hookean_dF2(F, C, D);
                SMatrix::from_fn(|i, j| H[(by_columns(i), by_columns(j))])
            },
            ..REFERENCE
        },
        "columns for rows",
    ),
    (
        "T_linear_tetrahedron",
        Functions { T_linear_tetrahedron: |v, e, r, w| 2.0 * solved::T_linear_tetrahedron(v, e, r, w), ..REFERENCE },
        "scaled by 2",
    ),
    (
        "T_linear_tetrahedron",
        Functions { T_linear_tetrahedron: |v, e, r, _| solved::T_linear_tetrahedron(v, e, r, 1.0), ..REFERENCE },
        "missing volume",
    ),
    (
        "quadrature_single_point",
        Functions {
            quadrature_single_point: |V, e, w, f| solved::quadrature_single_point(V, e, w, f) / 6.0,
            ..REFERENCE
        },
        "scaled by 1/6",
    ),
];

pub const ENERGIES: &[Mistake] = &[
    (
        "V_linear_tetrahedron",
        Functions {
            V_linear_tetrahedron: |q, V, e, _, C, D| solved::V_linear_tetrahedron(q, V, e, 1.0, C, D),
            ..REFERENCE
        },
        "missing volume",
    ),
    (
        "dV_linear_tetrahedron_dq",
        Functions {
            dV_linear_tetrahedron_dq: |q, V, e, w, C, D| {
                let f = solved::dV_linear_tetrahedron_dq(q, V, e, w, C, D);
                SVector::from_fn(|k, _| f[3 * (k % 4) + k / 4])
            },
            ..REFERENCE
        },
        "grouped by coordinate",
    ),
    (
        "dV_linear_tetrahedron_dq",
        Functions {
            dV_linear_tetrahedron_dq: |_, V, e, w, C, D| {
                let rest = DVector::from_iterator(3 * V.len(), V.iter().flatten().copied());
                solved::dV_linear_tetrahedron_dq(&rest, V, e, w, C, D)
            },
            ..REFERENCE
        },
        "zero",
    ),
    (
        "d2V_linear_tetrahedron_dq2",
        Functions {
            d2V_linear_tetrahedron_dq2: |q, V, e, w, C, D| {
                solved::given::project(&solved::d2V_linear_tetrahedron_dq2(q, V, e, w, C, D))
            },
            ..REFERENCE
        },
        "projected",
    ),
    (
        "V_spring_particle_particle",
        Functions { V_spring_particle_particle: |a, b, _, k| 0.5 * k * (b - a).norm_squared(), ..REFERENCE },
        "missing rest length",
    ),
    (
        "dV_spring_particle_particle_dq",
        Functions {
            dV_spring_particle_particle_dq: |a, b, l0, k| solved::dV_spring_particle_particle_dq(b, a, l0, k),
            ..REFERENCE
        },
        "negated",
    ),
    (
        "mass_matrix_linear_tetrahedron",
        Functions {
            mass_matrix_linear_tetrahedron: |_, w| solved::mass_matrix_linear_tetrahedron(1.0, w),
            ..REFERENCE
        },
        "missing density",
    ),
];

pub const MESHES: &[Mistake] = &[
    (
        "mass_matrix_mesh",
        Functions {
            mass_matrix_mesh: |n, T, r, v0| {
                let mut M = nalgebra_sparse::CooMatrix::new(n, n);
                for (e, w) in T.iter().zip(v0) {
                    (0..12).for_each(|i| M.push(3 * e[i / 3] + i % 3, 3 * e[i / 3] + i % 3, r * w / 4.0));
                }
                (&M).into()
            },
            ..REFERENCE
        },
        "lumped",
    ),
    (
        "assemble_forces",
        Functions { assemble_forces: |q, V, T, v0, C, D| -solved::assemble_forces(q, V, T, v0, C, D), ..REFERENCE },
        "negated",
    ),
    (
        "assemble_forces",
        Functions {
            assemble_forces: |q, V, T, v0, C, D| {
                let mut f = DVector::zeros(q.len());
                for (e, w) in T.iter().zip(v0) {
                    let g = solved::dV_linear_tetrahedron_dq(q, V, e, *w, C, D);
                    (0..12).for_each(|i| f[3 * e[i / 3] + i % 3] = -g[i]);
                }
                f
            },
            ..REFERENCE
        },
        "overwritten instead of added",
    ),
    (
        "assemble_stiffness",
        Functions {
            assemble_stiffness: |q, V, T, v0, C, D| {
                let mut K = solved::given::sparsity(q.len(), T);
                for (e, w) in T.iter().zip(v0) {
                    let H = -solved::d2V_linear_tetrahedron_dq2(q, V, e, *w, C, D);
                    for k in 0..16 {
                        let block = H.fixed_view::<3, 3>(3 * (k / 4), 3 * (k % 4)).into_owned();
                        solved::given::add_block(&mut K, e[k / 4], e[k % 4], &block);
                    }
                }
                K
            },
            ..REFERENCE
        },
        "not projected",
    ),
    (
        "build_skinning_matrix",
        Functions { build_skinning_matrix: |V, T, S| solved::build_skinning_matrix(V, T, S).transpose(), ..REFERENCE },
        "transposed",
    ),
    (
        "fixed_point_constraints",
        Functions { fixed_point_constraints: |n, i| solved::fixed_point_constraints(n, i).transpose(), ..REFERENCE },
        "transposed",
    ),
    (
        "pick_nearest_vertices",
        Functions {
            pick_nearest_vertices: |win, view, proj, port, V, F, r| {
                let y = f64::from(2.0 * port[1] + port[3]) - win.y;
                solved::pick_nearest_vertices(&Vector3::new(win.x, y, 0.0), view, proj, port, V, F, r)
            },
            ..REFERENCE
        },
        "upside down",
    ),
];

pub const STEPS: &[Mistake] = &[
    (
        "linearly_implicit_euler",
        Functions {
            linearly_implicit_euler: |q, v, dt, M, f, K, solve| {
                let (start, old) = (q.clone(), v.clone());
                solved::linearly_implicit_euler(q, v, dt, M, f, K, solve);
                *q = start + old * dt;
            },
            ..REFERENCE
        },
        "old velocity",
    ),
    (
        "linearly_implicit_euler",
        Functions {
            linearly_implicit_euler: |q, v, dt, M, f, K, solve| {
                solved::linearly_implicit_euler(q, v, dt, M, f, |q, v| K(q, v) * -1.0, solve);
            },
            ..REFERENCE
        },
        "stiffness with the wrong sign",
    ),
    (
        "newtons_method",
        Functions {
            newtons_method: |x, f, g, H, solve, most| solved::newtons_method(x, f, g, H, solve, most.min(1)),
            ..REFERENCE
        },
        "a single step",
    ),
    (
        "implicit_euler",
        Functions {
            implicit_euler: |q, v, dt, M, e, f, K, solve| {
                let start = q.clone();
                solved::implicit_euler(q, v, dt, M, e, f, K, solve);
                *q = start;
            },
            ..REFERENCE
        },
        "positions not moved",
    ),
];
