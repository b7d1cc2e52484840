//! Assembly, skinning and constraints.

use finite_elements_3d::given::project;
use nalgebra::{DMatrix, SMatrix, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::super::Mistake;
use super::super::by_hand::{gathered, global, masked, scattered};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(mass_matrix_mesh, ["factor 3 left out of the place"], |q_size, T, density, v0| {
        scattered(q_size, T, |t, i| t[i / 3] + i % 3, |e| right!(mass_matrix_linear_tetrahedron(density, v0[e])))
    }),
    wrong!(mass_matrix_mesh, ["last element left out"], |q_size, T, density, v0| {
        right!(mass_matrix_mesh(q_size, &T[..T.len() - 1], density, &v0[..T.len() - 1]))
    }),
    wrong!(mass_matrix_mesh, ["only the first element"], |q_size, T, density, v0| right!(mass_matrix_mesh(
        q_size,
        &T[..1],
        density,
        &v0[..1]
    ))),
    wrong!(mass_matrix_mesh, ["only diagonal"], |q_size, T, density, v0| {
        masked(&right!(mass_matrix_mesh(q_size, T, density, v0)), |i, j| i / 3 == j / 3)
    }),
    wrong!(mass_matrix_mesh, ["lumped"], |q_size, T, density, v0| {
        let M = DMatrix::from(&right!(mass_matrix_mesh(q_size, T, density, v0)));
        let sums = M.column_sum();
        CsrMatrix::from(&DMatrix::from_diagonal(&sums))
    }),
    wrong!(mass_matrix_mesh, ["mean volume for all"], |q_size, T, density, v0| {
        let mean = v0.iter().sum::<f64>() / v0.len() as f64;
        right!(mass_matrix_mesh(q_size, T, density, &vec![mean; v0.len()]))
    }),
    wrong!(mass_matrix_mesh, ["only the element's upper triangle"], |q_size, T, density, v0| {
        scattered(q_size, T, global, |e| {
            let M = right!(mass_matrix_linear_tetrahedron(density, v0[e]));
            SMatrix::from_fn(|i, j| if i <= j { M[(i, j)] } else { 0.0 })
        })
    }),
    wrong!(mass_matrix_mesh, ["last vertex taken for the first"], |q_size, T, density, v0| {
        let sorted: Vec<[usize; 4]> = T.iter().map(|t| [t[0], t[1], t[2], t[0]]).collect();
        scattered(q_size, &sorted, global, |e| right!(mass_matrix_linear_tetrahedron(density, v0[e])))
    }),
    wrong!(assemble_forces, ["factor 3 left out of the place"], |q, V, T, v0, C, D| {
        gathered(q.len(), T, |t, i| t[i / 3] + i % 3, |e| -right!(dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D)))
    }),
    wrong!(assemble_forces, ["first element left out"], |q, V, T, v0, C, D| {
        right!(assemble_forces(q, V, &T[1..], &v0[1..], C, D))
    }),
    wrong!(assemble_forces, ["mean of the elements"], |q, V, T, v0, C, D| {
        let mut f = right!(assemble_forces(q, V, T, v0, C, D));
        for vertex in 0..V.len() {
            let valence = T.iter().filter(|t| t.contains(&vertex)).count().max(1);
            f.fixed_rows_mut::<3>(3 * vertex).unscale_mut(valence as f64);
        }
        f
    }),
    wrong!(assemble_forces, ["last vertex of each element left out"], |q, V, T, v0, C, D| {
        gathered(q.len(), T, global, |e| {
            let mut f = -right!(dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D));
            f.fixed_rows_mut::<3>(9).fill(0.0);
            f
        })
    }),
    wrong!(assemble_forces, ["whole volume for all"], |q, V, T, v0, C, D| {
        right!(assemble_forces(q, V, T, &vec![v0.iter().sum(); T.len()], C, D))
    }),
    wrong!(assemble_forces, ["absolute values with the sign of a force"], |q, V, T, v0, C, D| {
        gathered(q.len(), T, global, |e| right!(dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D)).abs() * -1.0)
    }),
    wrong!(assemble_stiffness, ["only diagonal blocks"], |q, V, T, v0, C, D| {
        masked(&right!(assemble_stiffness(q, V, T, v0, C, D)), |i, j| i / 3 == j / 3)
    }),
    wrong!(assemble_stiffness, ["only upper triangle"], |q, V, T, v0, C, D| {
        masked(&right!(assemble_stiffness(q, V, T, v0, C, D)), |i, j| i <= j)
    }),
    wrong!(assemble_stiffness, ["absolute eigenvalues"], |q, V, T, v0, C, D| {
        scattered(q.len(), T, global, |e| {
            let H = right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D));
            let mut eigen = H.symmetric_eigen();
            eigen.eigenvalues.apply(|value| *value = value.abs());
            -eigen.recompose()
        })
    }),
    wrong!(assemble_stiffness, ["factor 3 left out of the place"], |q, V, T, v0, C, D| {
        scattered(
            q.len(),
            T,
            |t, i| t[i / 3] + i % 3,
            |e| -project(&right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D))),
        )
    }),
    wrong!(assemble_stiffness, ["only the last element"], |q, V, T, v0, C, D| {
        let last = T.len() - 1;
        right!(assemble_stiffness(q, V, &T[last..], &v0[last..], C, D))
    }),
    wrong!(assemble_stiffness, ["missing volume"], |q, V, T, _, C, D| right!(assemble_stiffness(
        q,
        V,
        T,
        &vec![1.0; T.len()],
        C,
        D
    ))),
    wrong!(assemble_stiffness, ["not projected and negated"], |q, V, T, v0, C, D| {
        scattered(q.len(), T, global, |e| right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)))
    }),
    wrong!(assemble_stiffness, ["rest for deformed"], |q, V, T, v0, C, D| {
        let mut rest = q.clone();
        V.iter().enumerate().for_each(|(a, X)| rest.fixed_rows_mut::<3>(3 * a).copy_from(X));
        right!(assemble_stiffness(&rest, V, T, v0, C, D))
    }),
    wrong!(build_skinning_matrix, ["always the first element"], |V, T, V_skin| {
        rows(V, V_skin, |x| weights(V, &T[0], x))
    }),
    wrong!(build_skinning_matrix, ["equal weights"], |V, T, V_skin| {
        rows(V, V_skin, |x| best(V, T, x).0.iter().map(|&vertex| (vertex, 0.25)).collect())
    }),
    wrong!(build_skinning_matrix, ["nearest vertex"], |V, _, V_skin| {
        rows(V, V_skin, |x| {
            let nearest = (0..V.len()).min_by(|&a, &b| (V[a] - x).norm().total_cmp(&(V[b] - x).norm()));
            nearest.into_iter().map(|vertex| (vertex, 1.0)).collect()
        })
    }),
    wrong!(build_skinning_matrix, ["clamped without a sum of one"], |V, T, V_skin| {
        rows(V, V_skin, |x| best(V, T, x).1.into_iter().map(|(vertex, w)| (vertex, w.max(0.0))).collect())
    }),
    wrong!(build_skinning_matrix, ["transposed"], |V, T, V_skin| right!(build_skinning_matrix(V, T, V_skin))
        .transpose()),
    wrong!(build_skinning_matrix, ["sorted vertices"], |V, T, V_skin| {
        rows(V, V_skin, |x| {
            let (mut element, weights) = best(V, T, x);
            element.sort_unstable();
            element.iter().zip(weights).map(|(&vertex, (_, w))| (vertex, w)).collect()
        })
    }),
    wrong!(build_skinning_matrix, ["last vertex left out"], |V, T, V_skin| {
        rows(V, V_skin, |x| best(V, T, x).1.into_iter().take(3).collect())
    }),
    wrong!(build_skinning_matrix, ["first element outside"], |V, T, V_skin| {
        rows(V, V_skin, |x| {
            if best(V, T, x).1.iter().all(|(_, w)| *w >= -1e-6) { best(V, T, x).1 } else { weights(V, &T[0], x) }
        })
    }),
    wrong!(fixed_point_constraints, ["fixed instead of free"], |q_size, indices| select(
        q_size,
        (0..q_size).filter(|c| indices.contains(&(c / 3)))
    )),
    wrong!(fixed_point_constraints, ["indices for coordinates"], |q_size, indices| select(
        q_size,
        (0..q_size).filter(|c| !indices.contains(c))
    )),
    wrong!(fixed_point_constraints, ["only x is fixed"], |q_size, indices| {
        select(q_size, (0..q_size).filter(|c| !indices.contains(&(c / 3)) || c % 3 != 0))
    }),
    wrong!(fixed_point_constraints, ["transposed"], |q_size, indices| right!(fixed_point_constraints(q_size, indices))
        .transpose()),
    wrong!(fixed_point_constraints, ["rows of zeros kept"], |q_size, indices| {
        let mut P = CooMatrix::new(q_size, q_size);
        (0..q_size).filter(|c| !indices.contains(&(c / 3))).for_each(|c| P.push(c, c, 1.0));
        CsrMatrix::from(&P)
    }),
    wrong!(fixed_point_constraints, ["everything is kept"], |q_size, _| CsrMatrix::identity(q_size)),
    wrong!(fixed_point_constraints, ["only the first index"], |q_size, indices| {
        right!(fixed_point_constraints(q_size, &indices[..indices.len().min(1)]))
    }),
    wrong!(fixed_point_constraints, ["grouped by coordinate"], |q_size, indices| {
        let n = q_size / 3;
        select(
            q_size,
            (0..3).flat_map(|axis| (0..n).map(move |a| 3 * a + axis)).filter(|c| !indices.contains(&(c / 3))),
        )
    }),
    wrong!(fixed_point_constraints, ["taken for sorted"], |q_size, indices| {
        let mut next = indices.iter().copied().peekable();
        select(
            q_size,
            (0..q_size).filter(move |c| {
                while next.peek().is_some_and(|&i| 3 * i + 2 < *c) {
                    next.next();
                }
                next.peek() != Some(&(c / 3))
            }),
        )
    }),
];

fn select(q_size: usize, kept: impl Iterator<Item = usize>) -> CsrMatrix<f64> {
    let kept: Vec<_> = kept.collect();
    let mut P = CooMatrix::new(kept.len(), q_size);
    kept.iter().enumerate().for_each(|(row, &column)| P.push(row, column, 1.0));
    CsrMatrix::from(&P)
}

type Weights = Vec<(usize, f64)>;

fn rows(V: &[Vector3<f64>], V_skin: &[Vector3<f64>], of: impl Fn(&Vector3<f64>) -> Weights) -> CsrMatrix<f64> {
    let mut N = CooMatrix::new(V_skin.len(), V.len());
    for (row, x) in V_skin.iter().enumerate() {
        of(x).into_iter().for_each(|(column, w)| N.push(row, column, w));
    }
    CsrMatrix::from(&N)
}

fn weights(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Weights {
    let phi = right!(phi_linear_tetrahedron(V, element, x));
    element.iter().copied().zip(phi.iter().copied()).collect()
}

fn best(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>) -> ([usize; 4], Weights) {
    let least = |t: &[usize; 4]| right!(phi_linear_tetrahedron(V, t, x)).min();
    let found = T.iter().max_by(|a, b| least(a).total_cmp(&least(b))).copied().unwrap_or_default();
    (found, weights(V, &found, x))
}
