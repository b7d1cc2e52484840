//! Assembly, skinning and constraints.

use finite_elements_3d::given::project;
use nalgebra::{DMatrix, DVector, SMatrix, Vector3, Vector4};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::super::Mistake;
use super::super::by_hand::{gathered, global, masked, scattered};

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(mass_matrix_mesh, ["grouped by coordinate"], |q_size, T, density, v0| {
        let n = q_size / 3;
        scattered(q_size, T, |t, i| t[i / 3] + n * (i % 3), |e| right!(mass_matrix_linear_tetrahedron(density, v0[e])))
    }),
    wrong!(mass_matrix_mesh, ["missing volume"], |q_size, T, density, v0| {
        right!(mass_matrix_mesh(q_size, T, density, &vec![1.0; v0.len()]))
    }),
    wrong!(mass_matrix_mesh, ["scaled by density", "density squared"], |q_size, T, density, v0| {
        right!(mass_matrix_mesh(q_size, T, density * density, v0))
    }),
    wrong!(mass_matrix_mesh, ["only upper triangle"], |q_size, T, density, v0| {
        masked(&right!(mass_matrix_mesh(q_size, T, density, v0)), |i, j| i <= j)
    }),
    wrong!(
        mass_matrix_mesh,
        ["coordinates not kept apart", "diagonal of each block filled"],
        |q_size, T, density, v0| {
            // A 4×4 matrix spread over blocks that are full.
            scattered(q_size, T, global, |e| {
                SMatrix::from_fn(|i, j| density * v0[e] / if i / 3 == j / 3 { 10.0 } else { 20.0 })
            })
        }
    ),
    wrong!(
        mass_matrix_mesh,
        [
            "only off-diagonal blocks",
            "element's diagonal blocks left out",
            "missing diagonal blocks",
            "missing diagonal"
        ],
        |q_size, T, density, v0| { masked(&right!(mass_matrix_mesh(q_size, T, density, v0)), |i, j| i / 3 != j / 3) }
    ),
    // Mass matrix in which each vertex has the mean mass.
    wrong!(mass_matrix_mesh, ["equal masses", "lumped with the mean mass"], |q_size, _, density, v0| {
        CsrMatrix::identity(q_size) * (density * v0.iter().sum::<f64>() * 3.0 / q_size as f64)
    }),
    wrong!(assemble_forces, ["negated"], |q, V, T, v0, C, D| -right!(assemble_forces(q, V, T, v0, C, D))),
    wrong!(assemble_forces, ["only the last element", "overwritten instead of added"], |q, V, T, v0, C, D| {
        let mut f = DVector::zeros(q.len());
        for (t, &volume) in T.iter().zip(v0) {
            f.fill(0.0);
            let g = right!(dV_linear_tetrahedron_dq(q, V, t, volume, C, D));
            (0..12).for_each(|i| f[global(t, i)] -= g[i]);
        }
        f
    }),
    wrong!(assemble_forces, ["coordinates in reverse"], |q, V, T, v0, C, D| {
        gathered(
            q.len(),
            T,
            |t, i| 3 * t[i / 3] + 2 - i % 3,
            |e| -right!(dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D)),
        )
    }),
    wrong!(assemble_forces, ["wrong vertex order"], |q, V, T, v0, C, D| {
        gathered(
            q.len(),
            T,
            |t, i| 3 * t[3 - i / 3] + i % 3,
            |e| -right!(dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D)),
        )
    }),
    wrong!(assemble_forces, ["missing last vertex"], |q, V, T, v0, C, D| {
        let mut f = right!(assemble_forces(q, V, T, v0, C, D));
        let n = f.len();
        f.rows_mut(n - 3, 3).fill(0.0);
        f
    }),
    wrong!(assemble_forces, ["C and D swapped"], |q, V, T, v0, C, D| right!(assemble_forces(q, V, T, v0, D, C))),
    wrong!(assemble_forces, ["only x", "only x of each vertex"], |q, V, T, v0, C, D| {
        let f = right!(assemble_forces(q, V, T, v0, C, D));
        DVector::from_fn(f.len(), |i, _| if i % 3 == 0 { f[i] } else { 0.0 })
    }),
    // Each element's force is subtracted from that before it.
    wrong!(assemble_forces, ["alternating signs"], |q, V, T, v0, C, D| {
        gathered(q.len(), T, global, |e| {
            right!(dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D)) * if e % 2 == 0 { -1.0 } else { 1.0 }
        })
    }),
    wrong!(assemble_stiffness, ["negated"], |q, V, T, v0, C, D| -right!(assemble_stiffness(q, V, T, v0, C, D))),
    wrong!(assemble_stiffness, ["first volume for all"], |q, V, T, v0, C, D| {
        right!(assemble_stiffness(q, V, T, &vec![v0[0]; v0.len()], C, D))
    }),
    wrong!(
        assemble_stiffness,
        ["missing diagonal blocks", "element's diagonal blocks left out"],
        |q, V, T, v0, C, D| {
            scattered(q.len(), T, global, |e| {
                let K = project(&right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)));
                SMatrix::from_fn(|i, j| if i / 3 == j / 3 { 0.0 } else { -K[(i, j)] })
            })
        }
    ),
    wrong!(
        assemble_stiffness,
        ["projected twice", "only negative eigenvalues kept", "eigenvalues cut off above", "projected after the minus"],
        |q, V, T, v0, C, D| {
            // The projection keeps the wrong half.
            scattered(q.len(), T, global, |e| {
                let H = right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D));
                project(&H) - H
            })
        }
    ),
    wrong!(assemble_stiffness, ["wrong vertex order"], |q, V, T, v0, C, D| {
        scattered(
            q.len(),
            T,
            |t, i| 3 * t[(i / 3 + 1) % 4] + i % 3,
            |e| -project(&right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D))),
        )
    }),
    wrong!(
        assemble_stiffness,
        ["doubled off the diagonal", "all but the diagonal scaled by 2", "all but the diagonal blocks scaled by 2"],
        |q, V, T, v0, C, D| {
            // Symmetric entries are added for both orders of the pair.
            scattered(q.len(), T, global, |e| {
                let K = project(&right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)));
                SMatrix::from_fn(|i, j| if i / 3 == j / 3 { -K[(i, j)] } else { -2.0 * K[(i, j)] })
            })
        }
    ),
    wrong!(assemble_stiffness, ["row sums to zero by force"], |q, V, T, v0, C, D| {
        let mut K = DMatrix::from(&right!(assemble_stiffness(q, V, T, v0, C, D)));
        for i in 0..K.nrows() {
            let others: f64 = K.row(i).sum() - K[(i, i)];
            K[(i, i)] = -others;
        }
        CsrMatrix::from(&K)
    }),
    // The element's matrix is projected with a floor above zero.
    wrong!(assemble_stiffness, ["eigenvalues raised above zero"], |q, V, T, v0, C, D| {
        scattered(q.len(), T, global, |e| {
            let mut eigen = right!(d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)).symmetric_eigen();
            let floor = 1e-2 * eigen.eigenvalues.amax();
            eigen.eigenvalues.apply(|value| *value = value.max(floor));
            -eigen.recompose()
        })
    }),
    // Any element in whose bounding box the point lies.
    wrong!(build_skinning_matrix, ["bounding box"], |V, T, V_skin| {
        rows(V, V_skin, |x| {
            let inside = |t: &&[usize; 4]| {
                let (low, high) =
                    t.iter().fold((V[t[0]], V[t[0]]), |(low, high), &a| (low.inf(&V[a]), high.sup(&V[a])));
                (0..3).all(|i| low[i] <= x[i] && x[i] <= high[i])
            };
            let t = T.iter().find(inside).unwrap_or(&T[0]);
            t.iter().copied().zip(right!(phi_linear_tetrahedron(V, t, x)).iter().copied()).collect()
        })
    }),
    // Elements are tested by the sum of the weights, which is always one.
    wrong!(build_skinning_matrix, ["always the first element"], |V, T, V_skin| {
        rows(V, V_skin, |x| {
            let phi = |t: &[usize; 4]| right!(phi_linear_tetrahedron(V, t, x));
            let t = T.iter().find(|t| (phi(t).sum() - 1.0).abs() < 1e-6).unwrap_or(&T[0]);
            t.iter().copied().zip(phi(t).iter().copied()).collect()
        })
    }),
    wrong!(build_skinning_matrix, ["weights in reverse", "wrong vertex order"], |V, T, V_skin| {
        rows(V, V_skin, |x| {
            let t = best(V, T, x);
            let phi = right!(phi_linear_tetrahedron(V, &t, x));
            (0..4).map(|i| (t[i], phi[3 - i])).collect()
        })
    }),
    wrong!(build_skinning_matrix, ["empty row outside"], |V, T, V_skin| {
        rows(V, V_skin, |x| {
            let phi = |t: &[usize; 4]| right!(phi_linear_tetrahedron(V, t, x));
            let found = T.iter().find(|t| phi(t).iter().all(|w| (-1e-6..=1.0 + 1e-6).contains(w)));
            found.map_or(Vec::new(), |t| t.iter().copied().zip(phi(t).iter().copied()).collect())
        })
    }),
    wrong!(build_skinning_matrix, ["inverse distances"], |V, T, V_skin| {
        rows(V, V_skin, |x| {
            let t = best(V, T, x);
            let w = Vector4::from(t.map(|a| 1.0 / ((V[a] - x).norm() + 1e-12)));
            t.iter().copied().zip((w / w.sum()).iter().copied()).collect()
        })
    }),
    wrong!(build_skinning_matrix, ["scaled by 0.25", "weights scaled"], |V, T, V_skin| right!(build_skinning_matrix(
        V, T, V_skin
    )) * 0.25),
    // Rows are those of the mesh's own vertices.
    wrong!(build_skinning_matrix, ["rows in reverse"], |V, T, V_skin| {
        let N = DMatrix::from(&right!(build_skinning_matrix(V, T, V_skin)));
        let n = N.nrows();
        CsrMatrix::from(&DMatrix::from_fn(n, N.ncols(), |i, j| N[(n - 1 - i, j)]))
    }),
    wrong!(fixed_point_constraints, ["off by one", "coordinates off by one"], |q_size, indices| {
        select(q_size, (0..q_size).filter(|c| !indices.iter().any(|i| (3 * i + 1..3 * i + 4).contains(c))))
    }),
    wrong!(fixed_point_constraints, ["z is not fixed", "only x and y are fixed"], |q_size, indices| {
        select(q_size, (0..q_size).filter(|c| !indices.iter().any(|i| (3 * i..3 * i + 2).contains(c))))
    }),
    wrong!(fixed_point_constraints, ["vertices for coordinates", "one row for each vertex"], |q_size, indices| {
        // One row for each vertex that is free.
        let kept: Vec<usize> = (0..q_size / 3).filter(|a| !indices.contains(a)).collect();
        select(q_size, kept.into_iter())
    }),
    wrong!(
        fixed_point_constraints,
        [
            "repeated indices counted twice",
            "limiting case",
            "wrong size in a limiting case",
            "indices not adapted after a removal"
        ],
        |q_size, indices| {
            let mut free: Vec<usize> = (0..q_size).collect();
            for i in indices {
                let at = 3 * i.min(&(free.len() / 3));
                free.drain(at.min(free.len())..(at + 3).min(free.len()));
            }
            select(q_size, free.into_iter())
        }
    ),
    wrong!(fixed_point_constraints, ["negated"], |q_size, indices| right!(fixed_point_constraints(q_size, indices))
        * -1.0),
    wrong!(fixed_point_constraints, ["last index left out"], |q_size, indices| {
        right!(fixed_point_constraints(q_size, &indices[..indices.len().saturating_sub(1)]))
    }),
    // The columns are compressed too.
    wrong!(
        fixed_point_constraints,
        ["columns left out too", "identity of the free coordinates", "columns removed too"],
        |q_size, indices| {
            let n = (0..q_size).filter(|c| !indices.contains(&(c / 3))).count();
            CsrMatrix::identity(n)
        }
    ),
];

fn select(q_size: usize, kept: impl Iterator<Item = usize>) -> CsrMatrix<f64> {
    let kept: Vec<_> = kept.collect();
    let mut P = CooMatrix::new(kept.len(), q_size);
    kept.iter().enumerate().for_each(|(row, &column)| P.push(row, column, 1.0));
    CsrMatrix::from(&P)
}

fn rows(
    V: &[Vector3<f64>],
    V_skin: &[Vector3<f64>],
    of: impl Fn(&Vector3<f64>) -> Vec<(usize, f64)>,
) -> CsrMatrix<f64> {
    let mut N = CooMatrix::new(V_skin.len(), V.len());
    for (row, x) in V_skin.iter().enumerate() {
        of(x).into_iter().for_each(|(column, w)| N.push(row, column, w));
    }
    CsrMatrix::from(&N)
}

fn best(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>) -> [usize; 4] {
    let least = |t: &[usize; 4]| right!(phi_linear_tetrahedron(V, t, x)).min();
    T.iter().max_by(|a, b| least(a).total_cmp(&least(b))).copied().unwrap_or_default()
}
