//! Mistakes that were once named wrongly, or not at all.

use finite_elements_3d as solved;
use finite_elements_3d::given::project;
use grader::implementation::Local;
use grader_child::Functions;
use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::super::{Explanation, explain};
use crate::reference::REFERENCE;
use crate::variants;

type Picked<'a> = (&'a [Vector3<f64>], &'a [[usize; 3]], f64);

fn name(function: &str, functions: Functions) -> String {
    let Explanation { diagnosis, .. } = explain(function, 5, &Local(functions), variants::of(function));
    diagnosis.map_or_else(|| "no name".to_owned(), |diagnosis| diagnosis.name)
}

fn flat(M: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_fn(|k, _| M[(k / 3, k % 3)])
}

/// The vertices around the corner of the triangle that is nearest to the hit, given the vertices that are within the radius of the hit.
fn around_the_nearest_corner((V, F, radius): Picked, hit: &Vector3<f64>, triangle: usize) -> Vec<usize> {
    let corner = F[triangle].into_iter().min_by(|&a, &b| (V[a] - hit).norm().total_cmp(&(V[b] - hit).norm())).unwrap();
    (0..V.len()).filter(|&vertex| (V[vertex] - V[corner]).norm() <= radius).collect()
}

#[test]
fn picking_around_the_nearest_corner_is_named() {
    let functions = Functions {
        pick_nearest_vertices: |win, view, proj, viewport, V, F, radius| {
            let port = viewport.cast::<f64>();
            let back = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse().unwrap();
            let (x, y) = (2.0 * (win.x - port[0]) / port[2] - 1.0, 2.0 * (win.y - port[1]) / port[3] - 1.0);
            let at = |depth: f64| {
                let p = back * nalgebra::Vector4::new(x, y, depth, 1.0);
                p.xyz() / p.w
            };
            let (o, d) = (at(-1.0), at(1.0) - at(-1.0));
            let mut best: Option<(f64, usize)> = None;
            for (index, triangle) in F.iter().enumerate() {
                let [a, b, c] = triangle.map(|vertex| V[vertex]);
                let Some(s) = Matrix3::from_columns(&[b - a, c - a, -d]).lu().solve(&(o - a)) else { continue };
                let is_hit = s[0] >= -1e-9 && s[1] >= -1e-9 && s[0] + s[1] <= 1.0 + 1e-9 && s[2] >= 0.0;
                if is_hit && best.is_none_or(|(t, _)| s[2] < t) {
                    best = Some((s[2], index));
                }
            }
            best.map_or(Vec::new(), |(t, index)| around_the_nearest_corner((V, F, radius), &(o + d * t), index))
        },
        ..REFERENCE
    };
    assert_eq!(name("pick_nearest_vertices", functions), "distance from the nearest corner of the triangle");
}

/// Weights of every element that holds a display vertex, and of the nearest one if there is none.
fn without_a_break(
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    skin: &[Vector3<f64>],
    slack: f64,
    rest: bool,
) -> CsrMatrix<f64> {
    let mut N = CooMatrix::new(skin.len(), V.len());
    for (row, x) in skin.iter().enumerate() {
        let (mut best, mut chosen, mut is_found) = (f64::NEG_INFINITY, 0, false);
        for (e, element) in T.iter().enumerate() {
            let phi = solved::phi_linear_tetrahedron(V, element, x);
            if phi.min() >= -slack {
                (0..4).for_each(|i| N.push(row, element[i], phi[i]));
                is_found = true;
            }
            if phi.min() > best {
                (best, chosen) = (phi.min(), e);
            }
        }
        if !is_found && rest {
            let phi = solved::phi_linear_tetrahedron(V, &T[chosen], x);
            (0..4).for_each(|i| N.push(row, T[chosen][i], phi[i]));
        }
    }
    CsrMatrix::from(&N)
}

#[test]
fn skinning_without_a_break_is_named_whatever_the_slack() {
    let all = [
        Functions { build_skinning_matrix: |V, T, skin| without_a_break(V, T, skin, 1e-6, true), ..REFERENCE },
        Functions { build_skinning_matrix: |V, T, skin| without_a_break(V, T, skin, 0.0, true), ..REFERENCE },
        Functions { build_skinning_matrix: |V, T, skin| without_a_break(V, T, skin, 1e-9, true), ..REFERENCE },
        Functions { build_skinning_matrix: |V, T, skin| without_a_break(V, T, skin, 1e-6, false), ..REFERENCE },
    ];
    for functions in all {
        let name = name("build_skinning_matrix", functions);
        assert!(name.contains("all that hold it"), "{name}");
    }
}

/// The second derivative of the energy density from the derivative of the cofactors.
fn moduli(F: &Matrix3<f64>, C: f64, D: f64, of_cofactors: SMatrix<f64, 9, 9>) -> SMatrix<f64, 9, 9> {
    let (J, I) = (F.determinant(), F.norm_squared());
    let (f, c) = (flat(F), flat(&(F.try_inverse().unwrap().transpose() * J)));
    let g = J.powf(-2.0 / 3.0);
    SMatrix::identity() * (2.0 * C * g)
        + (f * c.transpose() + c * f.transpose()) * (-4.0 / 3.0 * C * g / J)
        + c * c.transpose() * (10.0 / 9.0 * C * I * g / (J * J) + 2.0 * D)
        + of_cofactors * (-2.0 / 3.0 * C * I * g / J + 2.0 * D * (J - 1.0))
}

fn of_cofactors(F: &Matrix3<f64>, hat: fn(&Vector3<f64>) -> Matrix3<f64>) -> SMatrix<f64, 9, 9> {
    let rows = [F.row(0).transpose(), F.row(1).transpose(), F.row(2).transpose()];
    let mut all = SMatrix::<f64, 9, 9>::zeros();
    let blocks = [(0, 1, -1.0, 2), (0, 2, 1.0, 1), (1, 0, 1.0, 2), (1, 2, -1.0, 0), (2, 0, -1.0, 1), (2, 1, 1.0, 0)];
    for (i, j, sign, row) in blocks {
        all.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&(hat(&rows[row]) * sign));
    }
    all
}

#[test]
fn one_sign_in_the_hessian_is_named() {
    let one_in_every_block = Functions {
        d2psi_neo_hookean_dF2: |F, C, D| {
            let hat = |a: &Vector3<f64>| Matrix3::new(0.0, -a[2], -a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0);
            moduli(F, C, D, of_cofactors(F, hat))
        },
        ..REFERENCE
    };
    let found = name("d2psi_neo_hookean_dF2", one_in_every_block);
    assert_eq!(found, "one sign of the cross product with the wrong sign");
    let one_entry = Functions {
        d2psi_neo_hookean_dF2: |F, C, D| {
            let mut of_cofactors = of_cofactors(F, Vector3::cross_matrix);
            of_cofactors[(4, 8)] *= -1.0;
            moduli(F, C, D, of_cofactors)
        },
        ..REFERENCE
    };
    let found = name("d2psi_neo_hookean_dF2", one_entry);
    assert!(found.contains("in some entries") && found.contains("with the wrong sign"), "{found}");
    let one_block = Functions {
        d2psi_neo_hookean_dF2: |F, C, D| {
            let mut of_cofactors = of_cofactors(F, Vector3::cross_matrix);
            of_cofactors.fixed_view_mut::<3, 3>(3, 6).scale_mut(-1.0);
            moduli(F, C, D, of_cofactors)
        },
        ..REFERENCE
    };
    assert_eq!(name("d2psi_neo_hookean_dF2", one_block), "one block with the wrong sign");
}

#[test]
fn volumes_that_are_taken_by_vertex_are_named() {
    let of_elements = Functions {
        assemble_forces: |q, V, T, v0, C, D| {
            let mut f = DVector::zeros(q.len());
            for element in T {
                let g = solved::dV_linear_tetrahedron_dq(q, V, element, v0[element[0]], C, D);
                (0..12).for_each(|i| f[3 * element[i / 3] + i % 3] -= g[i]);
            }
            f
        },
        mass_matrix_mesh: |n, T, density, v0| {
            let mut M = CooMatrix::new(n, n);
            for element in T {
                let own = solved::mass_matrix_linear_tetrahedron(density, v0[element[0]]);
                (0..144).for_each(|k| {
                    let (i, j) = (k / 12, k % 12);
                    M.push(3 * element[i / 3] + i % 3, 3 * element[j / 3] + j % 3, own[(i, j)]);
                });
            }
            CsrMatrix::from(&M)
        },
        ..REFERENCE
    };
    assert_eq!(name("assemble_forces", of_elements), "volumes by vertex");
    assert_eq!(name("mass_matrix_mesh", of_elements), "volumes by vertex");
    let of_rows = Functions {
        assemble_stiffness: |q, V, T, v0, C, D| {
            let mut K = CooMatrix::new(q.len(), q.len());
            for element in T {
                let H = project(&solved::d2V_linear_tetrahedron_dq2(q, V, element, 1.0, C, D));
                for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
                    let value = -v0[i / 3] * H[(i, j)];
                    K.push(3 * element[i / 3] + i % 3, 3 * element[j / 3] + j % 3, value);
                }
            }
            CsrMatrix::from(&K)
        },
        ..REFERENCE
    };
    assert_eq!(name("assemble_stiffness", of_rows), "volumes by local vertex");
}

#[test]
fn the_old_velocity_in_a_force_is_named_though_the_answers_are_right() {
    let functions = Functions {
        implicit_euler: |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let (q0, v0) = (q.clone(), qdot.clone());
            let g = |v: &DVector<f64>| mass * (v - &v0) - force(&(&q0 + v * dt), &v0) * dt;
            let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + v * dt), v) * (dt * dt);
            solved::newtons_method(qdot, energy, g, H, solve, 5);
            *q += &*qdot * dt;
        },
        ..REFERENCE
    };
    assert_eq!(name("implicit_euler", functions), "old velocity in the force");
}

#[test]
fn a_logarithmic_law_is_another_material_and_no_wrong_exponent() {
    let of =
        |stress: fn(&Matrix3<f64>, f64, f64) -> SVector<f64, 9>| Functions { dpsi_neo_hookean_dF: stress, ..REFERENCE };
    let square = of(|F, C, D| {
        let (J, G) = (F.determinant(), F.try_inverse().unwrap().transpose());
        flat(&((F - G) * (2.0 * C) + G * (2.0 * D * (J - 1.0) * J)))
    });
    let logarithm = of(|F, C, D| {
        let (J, G) = (F.determinant(), F.try_inverse().unwrap().transpose());
        flat(&((F - G) * (2.0 * C) + G * (2.0 * D * J.ln())))
    });
    for functions in [square, logarithm] {
        assert_eq!(name("dpsi_neo_hookean_dF", functions), "another material");
    }
    let halves = of(|F, C, D| {
        let (J, G) = (F.determinant(), F.try_inverse().unwrap().transpose());
        flat(&((F - G) * C + G * (D * J.ln())))
    });
    assert_eq!(name("dpsi_neo_hookean_dF", halves), "another material and scaled by 0.5");
    let moduli = Functions {
        d2psi_neo_hookean_dF2: |F, C, D| {
            let (J, c) = (F.determinant(), flat(&(F.try_inverse().unwrap().transpose() * F.determinant())));
            SMatrix::identity() * (2.0 * C)
                + c * c.transpose() * (2.0 * C / (J * J) + 2.0 * D * (1.0 - J.ln()) / (J * J))
                + of_cofactors(F, Vector3::cross_matrix) * (-2.0 * C / J + 2.0 * D * J.ln() / J)
        },
        ..REFERENCE
    };
    assert_eq!(name("d2psi_neo_hookean_dF2", moduli), "another material");
}
