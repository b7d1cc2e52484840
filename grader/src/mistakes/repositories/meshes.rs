//! Assembly, skinning, constraints, picking.

use finite_elements_3d as solved;
use finite_elements_3d::given::project;
use nalgebra::{DVector, Matrix3, Vector3, Vector4};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // Only one entry of each 3×3 block
    wrong!(mass_matrix_mesh, ["only the first coordinate", "only entries along x"], |q_size, T, density, v0| {
        let mut M = CooMatrix::new(q_size, q_size);
        for (t, &v) in T.iter().zip(v0) {
            let Me = solved::mass_matrix_linear_tetrahedron(density, v);
            for i in 0..4 {
                for j in 0..4 {
                    M.push(3 * t[i], 3 * t[j], Me[(3 * i, 3 * j)]);
                }
            }
        }
        CsrMatrix::from(&M)
    }),
    // The volume of the whole mesh for every element
    wrong!(mass_matrix_mesh, ["whole volume for all"], |q_size, T, density, v0| {
        let total: f64 = v0.iter().sum();
        solved::mass_matrix_mesh(q_size, T, density, &vec![total; v0.len()])
    }),
    // Local indices 0 to 3
    wrong!(assemble_forces, ["local for global indices"], |q, V, T, v0, C, D| {
        let mut f = DVector::zeros(q.len());
        for (t, &v) in T.iter().zip(v0) {
            let dV = solved::dV_linear_tetrahedron_dq(q, V, t, v, C, D);
            for i in 0..12 {
                f[i] -= dV[i];
            }
        }
        f
    }),
    // The loop over the vertices of an element ends too early.
    wrong!(assemble_forces, ["last vertex of each element left out"], |q, V, T, v0, C, D| {
        let mut f = DVector::zeros(q.len());
        for (t, &v) in T.iter().zip(v0) {
            let dV = solved::dV_linear_tetrahedron_dq(q, V, t, v, C, D);
            for i in 0..3 {
                for k in 0..3 {
                    f[3 * t[i] + k] -= dV[3 * i + k];
                }
            }
        }
        f
    }),
    // Projection after the minus
    wrong!(assemble_stiffness, ["projected after the minus"], |q, V, T, v0, C, D| {
        let mut K = CooMatrix::new(q.len(), q.len());
        for (t, &v) in T.iter().zip(v0) {
            let H = project(&-solved::d2V_linear_tetrahedron_dq2(q, V, t, v, C, D));
            push_blocks(&mut K, t, |i, j| H[(i, j)]);
        }
        CsrMatrix::from(&K)
    }),
    // Blocks of the transposed pair
    wrong!(assemble_stiffness, ["transposed"], |q, V, T, v0, C, D| {
        let mut K = CooMatrix::new(q.len(), q.len());
        for (t, &v) in T.iter().zip(v0) {
            let H = project(&solved::d2V_linear_tetrahedron_dq2(q, V, t, v, C, D));
            push_blocks(&mut K, t, |i, j| -H[(3 * (j / 3) + i % 3, 3 * (i / 3) + j % 3)]);
        }
        CsrMatrix::from(&K)
    }),
    // All weights from zero to one, no slack, and nothing outside
    wrong!(build_skinning_matrix, ["strict test", "empty row outside"], |V, T, V_skin| {
        let mut N = CooMatrix::new(V_skin.len(), V.len());
        for i in 0..V_skin.len() {
            for t in T {
                let phi = solved::phi_linear_tetrahedron(V, t, &V_skin[i]);
                if phi.iter().all(|&w| w >= 0.0 && w <= 1.0) {
                    for k in 0..4 {
                        N.push(i, t[k], phi[k]);
                    }
                    break;
                }
            }
        }
        CsrMatrix::from(&N)
    }),
    // Three rows for each display vertex
    wrong!(build_skinning_matrix, ["one row for each coordinate"], |V, T, V_skin| {
        let N = solved::build_skinning_matrix(V, T, V_skin);
        let mut wide = CooMatrix::new(3 * V_skin.len(), 3 * V.len());
        for (i, j, w) in N.triplet_iter() {
            for k in 0..3 {
                wide.push(3 * i + k, 3 * j + k, *w);
            }
        }
        CsrMatrix::from(&wide)
    }),
    // indices as coordinates
    wrong!(fixed_point_constraints, ["indices for coordinates"], |q_size, indices| {
        let free: Vec<usize> = (0..q_size).filter(|i| !indices.contains(i)).collect();
        let mut P = CooMatrix::new(free.len(), q_size);
        for (row, &column) in free.iter().enumerate() {
            P.push(row, column, 1.0);
        }
        CsrMatrix::from(&P)
    }),
    // glm::unproject with the window's y from the top
    wrong!(pick_nearest_vertices, ["upside down"], |win, view, proj, viewport, V, F, radius| {
        let flipped = Vector3::new(win.x, f64::from(viewport[3]) - win.y, 0.0);
        solved::pick_nearest_vertices(&flipped, view, proj, viewport, V, F, radius)
    }),
    // The eye as the origin of the line of sight, and the nearest vertex of each triangle that is hit
    wrong!(
        pick_nearest_vertices,
        ["only the triangle that is hit", "no radius"],
        |win, view, proj, viewport, V, F, _radius| {
            let Some((_, _, t)) = first_hit(win, view, proj, viewport, V, F) else { return Vec::new() };
            let mut found = F[t].to_vec();
            found.sort();
            found
        }
    ),
];

fn push_blocks(K: &mut CooMatrix<f64>, t: &[usize; 4], entry: impl Fn(usize, usize) -> f64) {
    for i in 0..12 {
        for j in 0..12 {
            K.push(3 * t[i / 3] + i % 3, 3 * t[j / 3] + j % 3, entry(i, j));
        }
    }
}

/// Distance, point and triangle of the first hit.
fn first_hit(
    win: &Vector3<f64>,
    view: &nalgebra::Matrix4<f32>,
    proj: &nalgebra::Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
) -> Option<(f64, Vector3<f64>, usize)> {
    let inv = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse()?;
    let vp = viewport.cast::<f64>();
    let (x, y) = (2.0 * (win.x - vp[0]) / vp[2] - 1.0, 2.0 * (win.y - vp[1]) / vp[3] - 1.0);
    let unproject = |z: f64| {
        let p = inv * Vector4::new(x, y, z, 1.0);
        Vector3::new(p.x, p.y, p.z) / p.w
    };
    let (o, d) = (unproject(-1.0), unproject(1.0) - unproject(-1.0));
    let mut best: Option<(f64, Vector3<f64>, usize)> = None;
    for (i, f) in F.iter().enumerate() {
        let (a, b, c) = (V[f[0]], V[f[1]], V[f[2]]);
        let Some(s) = Matrix3::from_columns(&[b - a, c - a, -d]).lu().solve(&(o - a)) else { continue };
        if s[0] >= -1e-9 && s[1] >= -1e-9 && s[0] + s[1] <= 1.0 + 1e-9 && s[2] >= 0.0 {
            if best.is_none_or(|(t, _, _)| s[2] < t) {
                best = Some((s[2], o + d * s[2], i));
            }
        }
    }
    best
}
