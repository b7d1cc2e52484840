//! To do: the elastic energy of one element. Read include-docs/V_linear_tetrahedron.md.

use nalgebra::{Matrix3, Vector3};

use super::meshes::{Tetrahedron, orders};
use super::outcome::{Outcome, near_number, waits, with_input};
use super::random::{constants, deformed_tetrahedron, for_all, for_some, rotation, tetrahedron, vector};
use super::scales::energy_terms;
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_rigid_motion_stores_no_energy,
    a_uniform_stretch_has_the_energy_of_its_change_of_volume,
    a_simple_shear_has_the_energy_of_the_closed_form,
    the_energy_is_volume_times_psi,
    the_given_volume_is_used,
    an_inverted_element_has_infinite_energy,
    the_order_of_the_vertices_does_not_matter,
    an_element_far_from_the_origin_stores_the_same_energy,
];

/// Energy of the element after X → F X + shift.
fn energy(course: &Course, t: &Tetrahedron, F: &Matrix3<f64>, shift: &Vector3<f64>, C: f64, D: f64) -> Answer<f64> {
    course.subject.V_linear_tetrahedron(&t.moved(F, shift), &t.V, &t.element, t.volume, C, D)
}

/// Round-off: F comes from positions, whose digits count against the lowest height of the element.
fn allowed(t: &Tetrahedron, F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    1e-11 * t.volume * energy_terms(F, C, D) * t.size() / t.height()
}

fn a_rigid_motion_stores_no_energy(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), rotation(), vector(-3.0..3.0), constants()), |(t, R, shift, (C, D))| {
        let found = energy(course, &t, &R, &(shift * t.size()), C, D)?;
        near_number("V of a moved and rotated element", found, 0.0, allowed(&t, &R, C, D))
    })
}

fn a_uniform_stretch_has_the_energy_of_its_change_of_volume(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), -1.0..1.0, constants()), |(t, power, (C, D))| {
        let (s, F) = (f64::exp(power), Matrix3::identity() * f64::exp(power));
        let expected = t.volume * D * (s.powi(3) - 1.0).powi(2);
        let found = energy(course, &t, &F, &Vector3::zeros(), C, D)?;
        near_number("V(s X) = volume · D (s³ − 1)²", found, expected, allowed(&t, &F, C, D))
    })
}

fn a_simple_shear_has_the_energy_of_the_closed_form(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), -2.0..2.0, constants()), |(t, gamma, (C, D))| {
        for (i, j) in [(0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)] {
            let mut F = Matrix3::identity();
            F[(i, j)] = gamma;
            let expected = t.volume * C * gamma * gamma;
            let found = energy(course, &t, &F, &Vector3::zeros(), C, D)?;
            near_number("V of a simple shear = volume · C γ²", found, expected, allowed(&t, &F, C, D))?;
        }
        Ok(())
    })
}

fn the_energy_is_volume_times_psi(course: &Course) -> Outcome {
    for_all(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let density = course.trusted.psi_neo_hookean(&F, C, D).map_err(waits("psi_neo_hookean"))?;
        let found = energy(course, &t, &F, &shift, C, D)?;
        near_number("V = volume · psi(F)", found, t.volume * density, allowed(&t, &F, C, D))
    })
}

fn the_given_volume_is_used(course: &Course) -> Outcome {
    let t = Tetrahedron::unit();
    let q = t.moved(&(Matrix3::identity() * 2.0), &Vector3::zeros());
    let found = course.subject.V_linear_tetrahedron(&q, &t.V, &t.element, 3.0, 1.0, 1.0)?;
    let rule = "V = volume · psi(F) with the given volume";
    with_input("q = 2 X of the unit tetrahedron, a volume of 3 m³, C = D = 1", near_number(rule, found, 147.0, 1e-11))
}

fn an_inverted_element_has_infinite_energy(course: &Course) -> Outcome {
    for_all(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        near_number("V of a mirrored element", energy(course, &t, &-F, &shift, C, D)?, f64::INFINITY, 0.0)
    })
}

fn the_order_of_the_vertices_does_not_matter(course: &Course) -> Outcome {
    for_some(course.seed, (deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let expected = energy(course, &t, &F, &shift, C, D)?;
        for order in orders() {
            let found = energy(course, &t.reordered(order), &F, &shift, C, D)?;
            near_number("V of the same element", found, expected, 10.0 * allowed(&t, &F, C, D))?;
        }
        Ok(())
    })
}

fn an_element_far_from_the_origin_stores_the_same_energy(course: &Course) -> Outcome {
    let offset = Vector3::new(1048576.0, -2097152.0, 524288.0);
    let t = Tetrahedron::new([3, 0, 6, 2], &Matrix3::identity(), &offset);
    let found = energy(course, &t, &(Matrix3::identity() * 2.0), &Vector3::zeros(), 1.0, 1.0)?;
    let rule = "V of a stretched element far from the origin; subtract positions first";
    with_input("q = 2 X, 1000 km away, C = D = 1", near_number(rule, found, t.volume * 49.0, 1e-6))
}
