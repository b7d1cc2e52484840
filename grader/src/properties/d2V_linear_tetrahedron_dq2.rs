//! To do: the Hessian of an element's elastic energy. Read include-docs/d2V_linear_tetrahedron_dq2.md.

use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

use super::finite_differences::jacobian;
use super::meshes::{Tetrahedron, orders};
use super::outcome::{Outcome, eigenvalues_of, holds, near, near_number, slack, waits};
use super::random::{constants, deformed_tetrahedron, for_all, for_some, rotation, tetrahedron};
use super::scales::{smallest_stretch, stiffness_terms};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    it_is_the_derivative_of_the_gradient,
    the_unit_tetrahedron_at_rest_agrees_with_a_calculation_by_hand,
    it_is_symmetric,
    translations_meet_no_resistance_in_any_state,
    at_rest_only_the_six_rigid_motions_have_no_stiffness,
    negative_curvature_is_returned_as_it_is,
    rows_and_columns_turn_with_the_body,
    rows_and_columns_follow_the_order_of_the_element,
    the_given_volume_is_used,
];

type Hessian = SMatrix<f64, 12, 12>;

fn d2V(course: &Course, t: &Tetrahedron, F: &Matrix3<f64>, shift: &Vector3<f64>, C: f64, D: f64) -> Answer<Hessian> {
    course.subject.d2V_linear_tetrahedron_dq2(&t.moved(F, shift), &t.V, &t.element, t.volume, C, D)
}

/// Size of the terms of the Hessian, N/m.
fn terms(t: &Tetrahedron, F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    t.volume / t.height().powi(2) * stiffness_terms(F, C, D)
}

/// Bound on the effect of round-off in the positions on a sum of terms.
fn allowed(t: &Tetrahedron, F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    1e-11 * terms(t, F, C, D) * t.size() / t.height() / smallest_stretch(F).min(1.0)
}

/// The twelve velocities of a rigid rotation about an axis.
fn spin(t: &Tetrahedron, axis: &Vector3<f64>) -> SVector<f64, 12> {
    let arms = t.X().map(|X| axis.cross(&(X - t.X()[0])));
    SVector::from_fn(|row, _| arms[row / 3][row % 3])
}

fn it_is_the_derivative_of_the_gradient(course: &Course) -> Outcome {
    for_some(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let entries = t.gather(&t.moved(&F, &shift));
        let forces = |x: &DVector<f64>| {
            let dV = course.trusted.dV_linear_tetrahedron_dq(&t.scatter(x), &t.V, &t.element, t.volume, C, D);
            Ok(DVector::from_column_slice(dV.map_err(waits("dV_linear_tetrahedron_dq"))?.as_slice()))
        };
        let expected = jacobian(forces, &entries, 0.05 * t.height() * smallest_stretch(&F))?;
        let scale = terms(&t, &F, C, D) * t.size() / t.height() / smallest_stretch(&F).min(1.0);
        near("differences of dV_linear_tetrahedron_dq", &d2V(course, &t, &F, &shift, C, D)?, &expected, 1e-9 * scale)
    })
}

fn the_unit_tetrahedron_at_rest_agrees_with_a_calculation_by_hand(course: &Course) -> Outcome {
    // Vertex 1 moves along x and y: only ∂u/∂X_0 changes, so the entries are λ + 2μ, 0, μ, divided by six.
    let (C, D) = (3.0, 10.0);
    let (shear, lambda) = (2.0 * C, 2.0 * D - 4.0 / 3.0 * C);
    let H = d2V(course, &Tetrahedron::unit(), &Matrix3::identity(), &Vector3::zeros(), C, D)? * 6.0;
    near_number("the stiffness of a vertex along its edge", H[(3, 3)], lambda + 2.0 * shear, 1e-12)?;
    near_number("the stiffness of a vertex across its edge", H[(4, 4)], shear, 1e-12)?;
    near_number("no coupling of a vertex along its edge with itself across it", H[(3, 4)], 0.0, 1e-12)?;
    near_number("vertex 1 along x, vertex 2 along y", H[(3, 7)], lambda, 1e-12)?;
    near_number("vertex 1 along y, vertex 2 along x", H[(4, 6)], shear, 1e-12)
}

fn it_is_symmetric(course: &Course) -> Outcome {
    for_all(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let H = d2V(course, &t, &F, &shift, C, D)?;
        near("a second derivative is symmetric", &H, &H.transpose(), allowed(&t, &F, C, D))
    })
}

fn translations_meet_no_resistance_in_any_state(course: &Course) -> Outcome {
    for_all(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let H = d2V(course, &t, &F, &shift, C, D)?;
        for axis in 0..3 {
            let translation = SVector::<f64, 12>::from_fn(|row, _| if row % 3 == axis { 1.0 } else { 0.0 });
            let force = H * translation;
            near("H times a translation", &force, &SVector::<f64, 12>::zeros(), allowed(&t, &F, C, D))?;
        }
        Ok(())
    })
}

fn at_rest_only_the_six_rigid_motions_have_no_stiffness(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), constants()), |(t, (C, D))| {
        let H = d2V(course, &t, &Matrix3::identity(), &Vector3::zeros(), C, D)?;
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let (force, limit) = (H * spin(&t, &axis), allowed(&t, &Matrix3::identity(), C, D) * t.size());
            near("H times a rotation, at rest", &force, &SVector::<f64, 12>::zeros(), limit * t.size() / t.height())?;
        }
        let eigenvalues = eigenvalues_of(&H)?;
        let zeros = eigenvalues.iter().filter(|value| value.abs() < slack(1e-11) * eigenvalues.max()).count();
        holds("at rest three translations and three rotations have eigenvalue zero, the others not", zeros == 6)?;
        holds("at rest no eigenvalue is negative", eigenvalues.min() > -slack(1e-11) * eigenvalues.max())
    })
}

fn negative_curvature_is_returned_as_it_is(course: &Course) -> Outcome {
    // Along uniform scaling about vertex 0, V = volume · D (s³ − 1)² curves by volume · 6D (5s⁴ − 2s).
    let (t, s, D) = (Tetrahedron::unit(), 0.5, 8.0);
    let H = d2V(course, &t, &(Matrix3::identity() * s), &Vector3::zeros(), 1.0, D)?;
    let scaling = SVector::<f64, 12>::from_fn(|row, _| t.X()[row / 3][row % 3]);
    let expected = t.volume * 6.0 * D * (5.0 * s.powi(4) - 2.0 * s);
    near_number(
        "curvature of a squeezed element; nothing is projected here",
        scaling.dot(&(H * scaling)),
        expected,
        1e-11,
    )
}

fn rows_and_columns_turn_with_the_body(course: &Course) -> Outcome {
    for_all(course.seed, (deformed_tetrahedron(), rotation(), constants()), |((t, F, shift), R, (C, D))| {
        let turn = Hessian::from_fn(|row, column| if row / 3 == column / 3 { R[(row % 3, column % 3)] } else { 0.0 });
        let expected = turn * d2V(course, &t, &F, &shift, C, D)? * turn.transpose();
        let found = d2V(course, &t, &(R * F), &(R * shift), C, D)?;
        near("H(R q) = R H(q) Rᵀ", &found, &expected, allowed(&t, &F, C, D))
    })
}

fn rows_and_columns_follow_the_order_of_the_element(course: &Course) -> Outcome {
    for_some(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let H = d2V(course, &t, &F, &shift, C, D)?;
        for order in orders() {
            let old = |row: usize| 3 * order[row / 3] + row % 3;
            let expected = Hessian::from_fn(|row, column| H[(old(row), old(column))]);
            let found = d2V(course, &t.reordered(order), &F, &shift, C, D)?;
            near("rows 3i to 3i + 2 belong to element[i]", &found, &expected, 10.0 * allowed(&t, &F, C, D))?;
        }
        Ok(())
    })
}

fn the_given_volume_is_used(course: &Course) -> Outcome {
    let t = Tetrahedron::unit();
    let q = t.moved(&Matrix3::new(1.2, 0.3, 0.0, -0.1, 0.9, 0.2, 0.0, 0.1, 1.1), &Vector3::zeros());
    let one = course.subject.d2V_linear_tetrahedron_dq2(&q, &t.V, &t.element, 1.0, 2.0, 3.0)?;
    let five = course.subject.d2V_linear_tetrahedron_dq2(&q, &t.V, &t.element, 5.0, 2.0, 3.0)?;
    near("H is proportional to the volume argument", &five, &(one * 5.0), 1e-11)
}
