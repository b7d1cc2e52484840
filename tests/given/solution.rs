//! Properties of our own solution that the pages do not ask of students: energies near rest to the digits that F has, the first
//! of several elements that contain a display vertex, gradients whose norm overflows, and time steps whose old velocity has an
//! infinite energy.

use std::cell::RefCell;

use finite_elements_3d::{
    build_skinning_matrix, implicit_euler, newtons_method, phi_linear_tetrahedron, psi_neo_hookean,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3, dmatrix, dvector};

use crate::for_all;
use grader::properties::bodies::{by_elimination, sparse};
use grader::properties::build_skinning_matrix::{overlapping, row};
use grader::properties::outcome::{Outcome, holds, near, near_number};
use grader::properties::psi_neo_hookean::energy_near_rest;
use grader::properties::random::{constants, deformation};

fn dense(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> DMatrix<f64> {
    DMatrix::from(&build_skinning_matrix(V, T, V_skin))
}

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
fn a_point_less_than_a_millionth_outside_counts_as_inside() -> Outcome {
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

/// One step of 1 s from x = 1 with mass 1 and the potential x − ln x, a wall at zero that cannot be passed. Returns the new
/// position and velocity, and the velocities at which Newton's method asked for a stiffness.
fn step_at_a_wall(velocity: f64) -> (f64, f64, Vec<f64>) {
    let (mut q, mut v, asked) = (dvector![1.0], dvector![velocity], RefCell::new(Vec::new()));
    let potential = |x: f64| if x > 0.0 { x - x.ln() } else { f64::INFINITY };
    let energy = |v: &DVector<f64>| 0.5 * (v[0] - velocity).powi(2) + potential(1.0 + v[0]);
    let force = |q: &DVector<f64>, _: &DVector<f64>| dvector![1.0 / q[0] - 1.0];
    let stiffness = |q: &DVector<f64>, v: &DVector<f64>| {
        asked.borrow_mut().push(v[0]);
        sparse(&dmatrix![-1.0 / (q[0] * q[0])])
    };
    implicit_euler(&mut q, &mut v, 1.0, &sparse(&dmatrix![1.0]), energy, force, stiffness, by_elimination);
    (q[0], v[0], asked.into_inner())
}

#[test]
fn a_velocity_through_a_wall_starts_from_zero_instead() -> Outcome {
    let (q, v, asked) = step_at_a_wall(-2.0);
    holds("q stays on its side of the wall", q > 0.0)?;
    holds("Newton starts from v = 0 where the old velocity has an infinite energy", asked.first() == Some(&0.0))?;
    near_number("and finds the end of the step (qdot in g stays the old one)", v + 2.0 - (1.0 / q - 1.0), 0.0, 1e-6)?;
    let (_, _, asked) = step_at_a_wall(-0.5);
    holds("a velocity with a finite energy is the start", asked.first() == Some(&-0.5))
}
