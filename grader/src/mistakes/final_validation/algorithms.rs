//! Functions of a mesh, picking, integrators and Newton's method.

use finite_elements_3d::given::{add_scaled, project};
use nalgebra::{DMatrix, DVector, SMatrix, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::super::Mistake;
use super::super::by_hand::{gathered, global, scattered};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(mass_matrix_mesh, ["first element left out"], |q_size, T, density, v0| right!(mass_matrix_mesh(
        q_size,
        &T[1..],
        density,
        &v0[1..]
    ))),
    wrong!(mass_matrix_mesh, ["scaled by 2"], |q_size, T, density, v0| right!(mass_matrix_mesh(
        q_size,
        T,
        2.0 * density,
        v0
    ))),
    wrong!(mass_matrix_mesh, ["overwritten instead of added"], |q_size, T, density, v0| {
        let mut M = DMatrix::zeros(q_size, q_size);
        for (t, &volume) in T.iter().zip(v0) {
            let own = right!(mass_matrix_linear_tetrahedron(density, volume));
            (0..144).for_each(|k| M[(global(t, k / 12), global(t, k % 12))] = own[(k / 12, k % 12)]);
        }
        CsrMatrix::from(&M)
    }),
    wrong!(mass_matrix_mesh, ["volumes in reverse"], |q_size, T, density, v0| {
        let reversed: Vec<f64> = v0.iter().rev().copied().collect();
        right!(mass_matrix_mesh(q_size, T, density, &reversed))
    }),
    wrong!(assemble_forces, ["every other element"], |q, V, T, v0, C, D| {
        let half: (Vec<_>, Vec<_>) = T.iter().copied().zip(v0.iter().copied()).step_by(2).unzip();
        right!(assemble_forces(q, V, &half.0, &half.1, C, D))
    }),
    wrong!(assemble_forces, ["grouped by coordinate"], |q, V, T, v0, C, D| {
        let n = q.len() / 3;
        gathered(
            q.len(),
            T,
            |t, i| t[i / 3] + n * (i % 3),
            |e| -right!(dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D)),
        )
    }),
    wrong!(assemble_forces, ["missing volume"], |q, V, T, _, C, D| right!(assemble_forces(
        q,
        V,
        T,
        &vec![1.0; T.len()],
        C,
        D
    ))),
    wrong!(assemble_forces, ["scaled by volume", "volume squared"], |q, V, T, v0, C, D| {
        let squares: Vec<f64> = v0.iter().map(|v| v * v).collect();
        right!(assemble_forces(q, V, T, &squares, C, D))
    }),
    wrong!(assemble_stiffness, ["not projected"], |q, V, T, v0, C, D| {
        scattered(q.len(), T, global, |e| -right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)))
    }),
    wrong!(assemble_stiffness, ["last element left out"], |q, V, T, v0, C, D| {
        let n = T.len() - 1;
        right!(assemble_stiffness(q, V, &T[..n], &v0[..n], C, D))
    }),
    wrong!(assemble_stiffness, ["only the element's upper triangle"], |q, V, T, v0, C, D| {
        scattered(q.len(), T, global, |e| {
            let H = project(&right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)));
            SMatrix::from_fn(|i, j| if i <= j { -H[(i, j)] } else { 0.0 })
        })
    }),
    wrong!(assemble_stiffness, ["first contribution kept"], |q, V, T, v0, C, D| {
        let mut K = DMatrix::zeros(q.len(), q.len());
        for (t, &volume) in T.iter().zip(v0) {
            let H = project(&right!(d2V_linear_tetrahedron_dq2(q, V, t, volume, C, D)));
            for k in 0..144 {
                let entry: &mut f64 = &mut K[(global(t, k / 12), global(t, k % 12))];
                if *entry == 0.0 {
                    *entry = -H[(k / 12, k % 12)];
                }
            }
        }
        CsrMatrix::from(&K)
    }),
    wrong!(build_skinning_matrix, ["always the last element"], |V, T, V_skin| right!(build_skinning_matrix(
        V,
        &T[T.len().saturating_sub(1)..],
        V_skin
    ))),
    wrong!(build_skinning_matrix, ["absolute values of the weights"], |V, T, V_skin| {
        let N = DMatrix::from(&right!(build_skinning_matrix(V, T, V_skin)));
        CsrMatrix::from(&N.abs())
    }),
    wrong!(
        build_skinning_matrix,
        ["only the largest weight", "nearest vertex", "only the vertex with the largest weight"],
        |V, T, V_skin| {
            let N = DMatrix::from(&right!(build_skinning_matrix(V, T, V_skin)));
            let mut one = CooMatrix::new(N.nrows(), N.ncols());
            (0..N.nrows()).for_each(|i| one.push(i, N.row(i).transpose().imax(), 1.0));
            CsrMatrix::from(&one)
        }
    ),
    wrong!(build_skinning_matrix, ["zero"], |V, _, V_skin| CsrMatrix::zeros(V_skin.len(), V.len())),
    wrong!(fixed_point_constraints, ["only y is fixed"], |q_size, indices| kept(q_size, |c| c % 3 != 1
        || !indices.contains(&(c / 3)))),
    wrong!(fixed_point_constraints, ["vertex 0 never fixed"], |q_size, indices| kept(q_size, |c| c < 3
        || !indices.contains(&(c / 3)))),
    wrong!(fixed_point_constraints, ["rows in reverse"], |q_size, indices| {
        let P = DMatrix::from(&right!(fixed_point_constraints(q_size, indices)));
        CsrMatrix::from(&DMatrix::from_fn(P.nrows(), q_size, |i, j| P[(P.nrows() - 1 - i, j)]))
    }),
    wrong!(
        fixed_point_constraints,
        ["the vertices between them", "the vertex between them is fixed"],
        |q_size, indices| {
            let (low, high) = (indices.iter().min().copied().unwrap_or(1), indices.iter().max().copied().unwrap_or(0));
            kept(q_size, |c| !(low..=high).contains(&(c / 3)))
        }
    ),
    wrong!(pick_nearest_vertices, ["upside down"], |win, view, proj, viewport, V, F, radius| {
        let y = f64::from(2.0 * viewport[1] + viewport[3]) - win.y;
        right!(pick_nearest_vertices(&Vector3::new(win.x, y, win.z), view, proj, viewport, V, F, radius))
    }),
    wrong!(pick_nearest_vertices, ["x and y swapped"], |win, view, proj, viewport, V, F, radius| {
        let view_of = viewport.cast::<f64>();
        let (x, y) = ((win.x - view_of[0]) / view_of[2], (win.y - view_of[1]) / view_of[3]);
        let swapped = Vector3::new(view_of[0] + y * view_of[2], view_of[1] + x * view_of[3], win.z);
        right!(pick_nearest_vertices(&swapped, view, proj, viewport, V, F, radius))
    }),
    wrong!(pick_nearest_vertices, ["only the first vertex"], |win, view, proj, viewport, V, F, radius| {
        let mut found = right!(pick_nearest_vertices(win, view, proj, viewport, V, F, radius));
        found.truncate(1);
        found
    }),
    wrong!(pick_nearest_vertices, ["empty", "no vertex"], |_, _, _, _, _, _, _| Vec::new()),
    wrong!(
        pick_nearest_vertices,
        ["first vertex left out", "vertex 0 never found", "only the surface"],
        |win, view, proj, viewport, V, F, radius| {
            let mut found = right!(pick_nearest_vertices(win, view, proj, viewport, V, F, radius));
            found.retain(|vertex| *vertex > 0);
            found
        }
    ),
    wrong!(
        linearly_implicit_euler,
        ["mass divided by dt in the matrix"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let A = add_scaled(&(mass * (1.0 / dt)), -dt * dt, &stiffness(q, qdot));
            *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
            q.axpy(dt, qdot, 1.0);
        }
    ),
    wrong!(linearly_implicit_euler, ["force left out"], |q, qdot, dt, mass, force, stiffness, solve| {
        right!(linearly_implicit_euler(q, qdot, dt, mass, &|q, v| force(q, v) * 0.0, stiffness, solve))
    }),
    wrong!(linearly_implicit_euler, ["stiffness with the wrong sign"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, dt * dt, &stiffness(q, qdot));
        *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(linearly_implicit_euler, ["positions moved backwards"], |q, qdot, dt, mass, force, stiffness, solve| {
        let start = q.clone();
        right!(linearly_implicit_euler(q, qdot, dt, mass, force, stiffness, solve));
        *q = start - &*qdot * dt;
    }),
    wrong!(newtons_method, ["one step too few"], |x0, f, g, H, solve, max_steps| right!(newtons_method(
        x0,
        f,
        g,
        H,
        solve,
        max_steps.saturating_sub(1)
    ))),
    wrong!(newtons_method, ["negated"], |x0, f, g, H, solve, max_steps| {
        right!(newtons_method(x0, f, g, H, &|A, b| solve(A, &-b), max_steps))
    }),
    wrong!(newtons_method, ["zero returned"], |x0, f, g, H, solve, max_steps| {
        right!(newtons_method(x0, f, g, H, solve, max_steps));
        0.0
    }),
    wrong!(
        newtons_method,
        ["identity for the Hessian", "gradient for the direction"],
        |x0, f, g, _, solve, max_steps| {
            let n = x0.len();
            right!(newtons_method(x0, f, g, &|_| CsrMatrix::identity(n), solve, max_steps))
        }
    ),
    wrong!(newtons_method, ["missing backtracking"], |x0, f, g, H, solve, max_steps| {
        for _ in 0..max_steps {
            let gradient = g(x0);
            if gradient.norm() < 1e-12 {
                break;
            }
            *x0 += solve(&H(x0), &-gradient);
        }
        f(x0)
    }),
    wrong!(implicit_euler, ["force at the start of the step"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (start, old) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &old) - force(&start, v) * dt;
        let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&start + v * dt), v));
        right!(newtons_method(qdot, energy, &g, &H, solve, 5));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(implicit_euler, ["missing term"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let start = q.clone();
        let g = |v: &DVector<f64>| mass * v - force(&(&start + v * dt), v) * dt;
        let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&start + v * dt), v));
        right!(newtons_method(qdot, energy, &g, &H, solve, 5));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(implicit_euler, ["positions not moved"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        right!(implicit_euler(&mut q.clone(), qdot, dt, mass, energy, force, stiffness, solve))
    }),
    wrong!(implicit_euler, ["too few steps"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (start, old) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&start + v * dt), v) * dt;
        let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&start + v * dt), v));
        right!(newtons_method(qdot, energy, &g, &H, solve, 2));
        q.axpy(dt, qdot, 1.0);
    }),
];

fn kept(q_size: usize, keeps: impl Fn(usize) -> bool) -> CsrMatrix<f64> {
    let kept: Vec<_> = (0..q_size).filter(|&c| keeps(c)).collect();
    let mut P = CooMatrix::new(kept.len(), q_size);
    kept.iter().enumerate().for_each(|(row, &column)| P.push(row, column, 1.0));
    CsrMatrix::from(&P)
}
