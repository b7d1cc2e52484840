//! To do: the gradient of an element's elastic energy. Read include-docs/dV_linear_tetrahedron_dq.md.

use nalgebra::{DVector, Matrix3, SVector, Vector3};

use super::finite_differences::gradient;
use super::meshes::{Tetrahedron, orders};
use super::outcome::{Outcome, near, waits, with_input};
use super::random::{constants, deformed_tetrahedron, for_all, for_some, rotation, tetrahedron, vector};
use super::scales::{smallest_stretch, stress_terms};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_uniformly_stretched_unit_tetrahedron_agrees_with_a_calculation_by_hand,
    a_sheared_unit_tetrahedron_agrees_with_a_calculation_by_hand,
    it_is_the_gradient_of_the_energy,
    a_rigid_motion_causes_no_force,
    forces_and_torques_of_an_element_cancel,
    the_forces_turn_with_the_body,
    entries_follow_the_order_of_the_element,
    an_element_far_from_the_origin_has_the_same_force,
];

fn dV(
    course: &Course,
    t: &Tetrahedron,
    F: &Matrix3<f64>,
    shift: &Vector3<f64>,
    C: f64,
    D: f64,
) -> Answer<SVector<f64, 12>> {
    course.subject.dV_linear_tetrahedron_dq(&t.moved(F, shift), &t.V, &t.element, t.volume, C, D)
}

/// Size of the terms of the gradient, N.
fn terms(t: &Tetrahedron, F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    t.volume / t.height() * stress_terms(F, C, D)
}

/// Bound on the effect of round-off in the positions on a sum of terms.
fn allowed(t: &Tetrahedron, F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    1e-11 * terms(t, F, C, D) * t.size() / t.height() / smallest_stretch(F).min(1.0)
}

fn of_vertex(gradient: &SVector<f64, 12>, a: usize) -> Vector3<f64> {
    gradient.fixed_rows::<3>(3 * a).into_owned()
}

fn a_uniformly_stretched_unit_tetrahedron_agrees_with_a_calculation_by_hand(course: &Course) -> Outcome {
    // P = 2D (s³ − 1) s² 1 = 56 D for s = 2; ∂V/∂x_a = volume P ∇φ_a.
    let p = 56.0 * 3.0 / 6.0;
    let expected = SVector::<f64, 12>::from([-p, -p, -p, p, 0.0, 0.0, 0.0, p, 0.0, 0.0, 0.0, p]);
    let t = Tetrahedron::unit();
    let found = dV(course, &t, &(Matrix3::identity() * 2.0), &Vector3::zeros(), 1.0, 3.0)?;
    near("+∂V/∂q of a unit tetrahedron that is uniformly stretched", &found, &expected, 1e-11)
}

fn a_sheared_unit_tetrahedron_agrees_with_a_calculation_by_hand(course: &Course) -> Outcome {
    // F = 1 + γ e_0 ⊗ e_1: P = 2C (F − (1 + γ²/3) F^(−T)) and the columns of P are the gradients of vertices 1, 2, 3.
    let (gamma, C) = (0.6, 5.0);
    let third = 1.0 + gamma * gamma / 3.0;
    let (on_diagonal, p01, p10) = (2.0 * C * (1.0 - third), 2.0 * C * gamma, 2.0 * C * gamma * third);
    let columns =
        [Vector3::new(on_diagonal, p10, 0.0), Vector3::new(p01, on_diagonal, 0.0), Vector3::z() * on_diagonal];
    let sum: Vector3<f64> = columns.iter().sum();
    let F = Matrix3::new(1.0, gamma, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    let found = dV(course, &Tetrahedron::unit(), &F, &Vector3::zeros(), C, 11.0)? * 6.0;
    for (a, expected) in [-sum, columns[0], columns[1], columns[2]].iter().enumerate() {
        near("entries 3i to 3i + 2 belong to element[i]; mind P or Pᵀ", &of_vertex(&found, a), expected, 1e-12)?;
    }
    Ok(())
}

fn it_is_the_gradient_of_the_energy(course: &Course) -> Outcome {
    for_some(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let entries = t.gather(&t.moved(&F, &shift));
        let energy = |x: &DVector<f64>| {
            let V = course.trusted.V_linear_tetrahedron(&t.scatter(x), &t.V, &t.element, t.volume, C, D);
            V.map_err(waits("V_linear_tetrahedron"))
        };
        let expected = gradient(energy, &entries, 0.05 * t.height() * smallest_stretch(&F))?;
        let scale = terms(&t, &F, C, D) * t.size() / t.height() / smallest_stretch(&F).min(1.0);
        near("differences of V_linear_tetrahedron", &dV(course, &t, &F, &shift, C, D)?, &expected, 1e-9 * scale)
    })
}

fn a_rigid_motion_causes_no_force(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), rotation(), vector(-3.0..3.0), constants()), |(t, R, shift, (C, D))| {
        let found = dV(course, &t, &R, &(shift * t.size()), C, D)?;
        near("dV of a moved and rotated element", &found, &SVector::<f64, 12>::zeros(), allowed(&t, &R, C, D))
    })
}

fn forces_and_torques_of_an_element_cancel(course: &Course) -> Outcome {
    for_all(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let found = dV(course, &t, &F, &shift, C, D)?;
        let force: Vector3<f64> = (0..4).map(|a| of_vertex(&found, a)).sum();
        near("the sum of the four forces", &force, &Vector3::zeros(), allowed(&t, &F, C, D))?;
        let arms = t.X().map(|X| F * (X - t.X()[0]));
        let torque: Vector3<f64> = (0..4).map(|a| arms[a].cross(&of_vertex(&found, a))).sum();
        let length = arms.iter().map(|arm| arm.norm()).fold(0.0, f64::max);
        near("the sum of the four torques", &torque, &Vector3::zeros(), allowed(&t, &F, C, D) * length)
    })
}

fn the_forces_turn_with_the_body(course: &Course) -> Outcome {
    for_all(course.seed, (deformed_tetrahedron(), rotation(), constants()), |((t, F, shift), R, (C, D))| {
        let here = dV(course, &t, &F, &shift, C, D)?;
        let turned = dV(course, &t, &(R * F), &(R * shift), C, D)?;
        for a in 0..4 {
            let expected = R * of_vertex(&here, a);
            near("dV(R q) = R dV(q)", &of_vertex(&turned, a), &expected, allowed(&t, &F, C, D))?;
        }
        Ok(())
    })
}

fn entries_follow_the_order_of_the_element(course: &Course) -> Outcome {
    for_some(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let here = dV(course, &t, &F, &shift, C, D)?;
        for order in orders() {
            let found = dV(course, &t.reordered(order), &F, &shift, C, D)?;
            for (a, old) in order.into_iter().enumerate() {
                let (rule, expected) = ("entries 3i to 3i + 2 belong to element[i]", of_vertex(&here, old));
                near(rule, &of_vertex(&found, a), &expected, 10.0 * allowed(&t, &F, C, D))?;
            }
        }
        Ok(())
    })
}

fn an_element_far_from_the_origin_has_the_same_force(course: &Course) -> Outcome {
    let p = 56.0 / 6.0;
    let expected = SVector::<f64, 12>::from([-p, -p, -p, p, 0.0, 0.0, 0.0, p, 0.0, 0.0, 0.0, p]);
    let offset = Vector3::new(1048576.0, -2097152.0, 524288.0);
    let t = Tetrahedron::new([3, 0, 6, 2], &Matrix3::identity(), &offset);
    let found = dV(course, &t, &(Matrix3::identity() * 2.0), &Vector3::zeros(), 1.0, 1.0)?;
    let rule = "dV of a stretched element far from the origin; subtract positions first";
    with_input("q = 2 X, 1000 km away, C = D = 1", near(rule, &found, &expected, 1e-6))
}
