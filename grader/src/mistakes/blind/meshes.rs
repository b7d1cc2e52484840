//! Functions of a mesh.

use finite_elements_3d as solved;
use nalgebra::{DMatrix, DVector, SMatrix};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // overwritten instead of added
    wrong!(mass_matrix_mesh, ["overwritten instead of added"], |q_size, T, density, v0| {
        let mut M = DMatrix::zeros(q_size, q_size);
        for (t, volume) in T.iter().zip(v0) {
            let Me = solved::mass_matrix_linear_tetrahedron(density, *volume);
            for i in 0..12 {
                for j in 0..12 {
                    M[(3 * t[i / 3] + i % 3, 3 * t[j / 3] + j % 3)] = Me[(i, j)];
                }
            }
        }
        dense_to_csr(&M)
    }),
    // the first element's volume for all
    wrong!(mass_matrix_mesh, ["first volume for all"], |q_size, T, density, v0| {
        let mut M = CooMatrix::new(q_size, q_size);
        for t in T {
            let Me = solved::mass_matrix_linear_tetrahedron(density, v0[0]);
            for i in 0..12 {
                for j in 0..12 {
                    M.push(3 * t[i / 3] + i % 3, 3 * t[j / 3] + j % 3, Me[(i, j)]);
                }
            }
        }
        CsrMatrix::from(&M)
    }),
    // only the diagonal blocks
    wrong!(mass_matrix_mesh, ["only diagonal"], |q_size, T, density, v0| {
        let mut M = CooMatrix::new(q_size, q_size);
        for (t, volume) in T.iter().zip(v0) {
            let Me = solved::mass_matrix_linear_tetrahedron(density, *volume);
            for a in 0..4 {
                for i in 0..3 {
                    for j in 0..3 {
                        M.push(3 * t[a] + i, 3 * t[a] + j, Me[(3 * a + i, 3 * a + j)]);
                    }
                }
            }
        }
        CsrMatrix::from(&M)
    }),
    // columns by local numbers
    wrong!(mass_matrix_mesh, ["local for global indices in the columns"], |q_size, T, density, v0| {
        let mut M = CooMatrix::new(q_size, q_size);
        for (t, volume) in T.iter().zip(v0) {
            let Me = solved::mass_matrix_linear_tetrahedron(density, *volume);
            for i in 0..12 {
                for j in 0..12 {
                    M.push(3 * t[i / 3] + i % 3, j, Me[(i, j)]);
                }
            }
        }
        CsrMatrix::from(&M)
    }),
    // sign
    wrong!(assemble_forces, ["negated"], |q, V, T, v0, C, D| {
        let mut f = DVector::zeros(q.len());
        for (t, v) in T.iter().zip(v0) {
            let g = solved::dV_linear_tetrahedron_dq(q, V, t, *v, C, D);
            for i in 0..12 {
                f[3 * t[i / 3] + i % 3] += g[i];
            }
        }
        f
    }),
    // last element left out
    wrong!(assemble_forces, ["one element too few"], |q, V, T, v0, C, D| {
        let mut f = DVector::zeros(q.len());
        for e in 0..T.len().saturating_sub(1) {
            let g = solved::dV_linear_tetrahedron_dq(q, V, &T[e], v0[e], C, D);
            for i in 0..12 {
                f[3 * T[e][i / 3] + i % 3] -= g[i];
            }
        }
        f
    }),
    // stacked by components
    wrong!(assemble_forces, ["grouped by coordinate"], |q, V, T, v0, C, D| {
        let mut f = DVector::zeros(q.len());
        for (t, v) in T.iter().zip(v0) {
            let g = solved::dV_linear_tetrahedron_dq(q, V, t, *v, C, D);
            for a in 0..4 {
                for i in 0..3 {
                    f[t[a] + i * V.len()] -= g[3 * a + i];
                }
            }
        }
        f
    }),
    // overwritten instead of added
    wrong!(assemble_forces, ["overwritten instead of added"], |q, V, T, v0, C, D| {
        let mut f = DVector::zeros(q.len());
        for (t, v) in T.iter().zip(v0) {
            let g = solved::dV_linear_tetrahedron_dq(q, V, t, *v, C, D);
            for i in 0..12 {
                f[3 * t[i / 3] + i % 3] = -g[i];
            }
        }
        f
    }),
    // not projected
    wrong!(assemble_stiffness, ["not projected"], |q, V, T, v0, C, D| {
        stiffness(q, T, |e| -solved::d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D))
    }),
    // sign
    wrong!(assemble_stiffness, ["negated"], |q, V, T, v0, C, D| {
        stiffness(q, T, |e| solved::given::project(&solved::d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)))
    }),
    // -H projected: the wrong side is cut
    wrong!(assemble_stiffness, ["projected after the minus"], |q, V, T, v0, C, D| {
        stiffness(q, T, |e| solved::given::project(&-solved::d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D)))
    }),
    // negative eigenvalues made positive in place of zero
    wrong!(assemble_stiffness, ["absolute eigenvalues"], |q, V, T, v0, C, D| {
        stiffness(q, T, |e| {
            let eigen = solved::d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D).symmetric_eigen();
            let absolute = SMatrix::<f64, 12, 12>::from_diagonal(&eigen.eigenvalues.abs());
            -(eigen.eigenvectors * absolute * eigen.eigenvectors.transpose())
        })
    }),
    // transposed
    wrong!(fixed_point_constraints, ["transposed"], |q_size, indices| {
        let free: Vec<usize> = (0..q_size).filter(|i| !indices.contains(&(i / 3))).collect();
        let mut P = CooMatrix::new(q_size, free.len());
        for (k, &i) in free.iter().enumerate() {
            P.push(i, k, 1.0);
        }
        CsrMatrix::from(&P)
    }),
    // keeps the fixed coordinates
    wrong!(fixed_point_constraints, ["fixed instead of free"], |q_size, indices| {
        let kept: Vec<usize> = (0..q_size).filter(|i| indices.contains(&(i / 3))).collect();
        let mut P = CooMatrix::new(kept.len(), q_size);
        for (k, &i) in kept.iter().enumerate() {
            P.push(k, i, 1.0);
        }
        CsrMatrix::from(&P)
    }),
    // vertex numbers taken for coordinates
    wrong!(fixed_point_constraints, ["indices for coordinates"], |q_size, indices| {
        let kept: Vec<usize> = (0..q_size).filter(|i| !indices.contains(i)).collect();
        let mut P = CooMatrix::new(kept.len(), q_size);
        for (k, &i) in kept.iter().enumerate() {
            P.push(k, i, 1.0);
        }
        CsrMatrix::from(&P)
    }),
    // an index named twice counts twice
    wrong!(fixed_point_constraints, ["panics in a limiting case"], |q_size, indices| {
        let rows = q_size - 3 * indices.len();
        let mut P = CooMatrix::new(rows, q_size);
        for (k, i) in (0..q_size).filter(|i| !indices.contains(&(i / 3))).enumerate() {
            P.push(k, i, 1.0);
        }
        CsrMatrix::from(&P)
    }),
];

fn dense_to_csr(M: &DMatrix<f64>) -> CsrMatrix<f64> {
    CsrMatrix::from(&CooMatrix::from(M))
}

fn stiffness(q: &DVector<f64>, T: &[[usize; 4]], element: impl Fn(usize) -> SMatrix<f64, 12, 12>) -> CsrMatrix<f64> {
    let mut K = CooMatrix::new(q.len(), q.len());
    for (e, t) in T.iter().enumerate() {
        let Ke = element(e);
        for i in 0..12 {
            for j in 0..12 {
                K.push(3 * t[i / 3] + i % 3, 3 * t[j / 3] + j % 3, Ke[(i, j)]);
            }
        }
    }
    CsrMatrix::from(&K)
}
