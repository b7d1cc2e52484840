//! What our own solution holds beyond what the pages ask of a student: energies near rest to the digits that F has, and the
//! first element of those that hold a display vertex, and numbers so large that a norm overflows.

use finite_elements_3d::{build_skinning_matrix, newtons_method, phi_linear_tetrahedron, psi_neo_hookean};
use nalgebra::{DVector, Matrix3, Vector3, dmatrix, dvector};

use crate::bodies::sparse;
use crate::build_skinning_matrix::{dense, overlapping, row};
use crate::outcome::{Outcome, for_all, holds, near, near_number};
use crate::psi_neo_hookean::energy_near_rest;
use crate::random::{constants, deformation};

#[test]
fn near_rest_the_error_shrinks_with_the_strain() -> Outcome {
    for_all((deformation(), -8.0..-2.5, constants()), |(direction, power, (C, D))| {
        let F = Matrix3::identity() + direction * 10f64.powf(power);
        let E = F - Matrix3::identity();
        let rule = "psi near rest, computed from F − 1";
        near_number(rule, psi_neo_hookean(&F, C, D), energy_near_rest(&E, C, D), 1e-15 * E.norm() * (C + D))
    })
}

#[test]
fn the_first_element_that_holds_the_point_is_taken() -> Outcome {
    let (V, [small, large]) = overlapping();
    let x = Vector3::new(0.1, 0.2, 0.3);
    let in_small = row(8, small, [0.4, 0.1, 0.2, 0.3]);
    let in_large = row(8, large, [0.7, 0.05, 0.1, 0.15]);
    near("two elements hold it, small first in T", &dense(&V, &[small, large], &[x]), &in_small, 1e-13)?;
    near("two elements hold it, large first in T", &dense(&V, &[large, small], &[x]), &in_large, 1e-13)
}

#[test]
fn a_shared_face_belongs_to_the_first_element() -> Outcome {
    let V = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(0.0, 0.0, -1.0)];
    let (above, below) = ([0, 1, 2, 3], [0, 2, 1, 4]);
    for T in [[above, below], [below, above]] {
        let N = build_skinning_matrix(&V, &T, &[Vector3::new(0.25, 0.25, 0.0)]);
        let mut expected = T[0].to_vec();
        expected.sort_unstable();
        let mut columns = N.row(0).col_indices().to_vec();
        columns.sort_unstable();
        holds("the weights of a shared face are those of the first element in T", columns == expected)?;
    }
    Ok(())
}

#[test]
fn a_point_within_a_millionth_outside_still_counts_as_inside() -> Outcome {
    let (V, [small, large]) = overlapping();
    // Just below the face z = 0 of both; then just past the slanted face, which the large element covers.
    let below = |depth: f64| Vector3::new(0.25, 0.25, -depth);
    let weights = |depth: f64| [0.5 + depth, 0.25, 0.25, -depth];
    let found = dense(&V, &[small, large], &[below(0.9e-6)]);
    near("0.9e-6 outside: the first that holds it", &found, &row(8, small, weights(0.9e-6)), 1e-12)?;
    for (past, element) in [(0.9e-6, small), (2e-6, large)] {
        let x = Vector3::new(0.5, 0.25, 0.25 + past);
        let phi = phi_linear_tetrahedron(&V, &element, &x);
        let found = dense(&V, &[small, large], &[x]);
        near("beyond 1e-6 the next element is asked", &found, &row(8, element, phi.into()), 1e-12)?;
    }
    for (axis, offset) in [(0, -3.0), (1, -3.0), (2, 5.0)].into_iter().flat_map(|(axis, o)| [(axis, o), (axis, -o)]) {
        // The same just outside each face of an element that lies elsewhere, with a far better one later in T.
        let shift = Vector3::ith(axis, offset);
        let moved: Vec<_> = V.iter().map(|X| X + shift).collect();
        let inner = [
            Vector3::new(-0.9e-6, 0.25, 0.25),
            Vector3::new(0.25, -0.9e-6, 0.25),
            Vector3::new(1.0 + 0.9e-6, 0.0, 0.0),
        ];
        for x in inner.map(|x| x + shift) {
            let phi = phi_linear_tetrahedron(&moved, &small, &x);
            let found = dense(&moved, &[small, large], &[x]);
            near("just outside the first element", &found, &row(8, small, phi.into()), 1e-12)?;
        }
    }
    Ok(())
}

#[test]
fn a_gradient_whose_norm_overflows_is_not_taken_for_a_small_one() -> Outcome {
    // ½ stiff (x − 1)²: the gradient is finite, its square is not.
    let stiff = 1e200;
    let mut x = dvector![0.0];
    let f = |x: &DVector<f64>| 0.5 * stiff * (x[0] - 1.0).powi(2);
    let g = |x: &DVector<f64>| dvector![stiff * (x[0] - 1.0)];
    let H = |_: &DVector<f64>| sparse(&dmatrix![stiff]);
    newtons_method(&mut x, f, g, H, |_, b| b / stiff, 5);
    near("the minimum of a very stiff parabola", &x, &dvector![1.0], 1e-12)
}
