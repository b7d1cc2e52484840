//! To do: the kinetic energy of one element. Read include-docs/T_linear_tetrahedron.md.

use nalgebra::{DVector, Matrix3, Vector3};

use super::meshes::{Tetrahedron, orders};
use super::outcome::{Outcome, holds, near_number, with_input};
use super::random::{deformation, for_all, for_some, tetrahedron, vector};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_translating_element_has_half_m_v_squared,
    one_moving_vertex_carries_a_tenth_of_the_mass,
    opposite_velocities_of_two_vertices_subtract,
    it_is_the_integral_of_half_density_times_speed_squared,
    the_given_volume_is_used,
    the_order_of_the_vertices_does_not_matter,
];

/// Kinetic energy where the velocity is `slope` X + `shift`; NaN at every vertex that is not the element's.
fn energy(course: &Course, t: &Tetrahedron, slope: &Matrix3<f64>, shift: &Vector3<f64>, density: f64) -> Answer<f64> {
    course.subject.T_linear_tetrahedron(&t.moved(slope, shift), &t.element, density, t.volume)
}

fn a_translating_element_has_half_m_v_squared(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), vector(-9.0..9.0), 1.0..1e4), |(t, v, density)| {
        let expected = 0.5 * density * t.volume * v.norm_squared();
        let found = energy(course, &t, &Matrix3::zeros(), &v, density)?;
        near_number("T = ½ ρ volume |v|²", found, expected, 1e-13 * expected)
    })
}

fn one_moving_vertex_carries_a_tenth_of_the_mass(course: &Course) -> Outcome {
    // ∫ φ_a² = volume / 10.
    for a in 0..4 {
        let mut entries = DVector::zeros(12);
        entries[3 * a + 1] = 2.0;
        let t = Tetrahedron::new([5, 1, 8, 2], &Matrix3::identity(), &Vector3::zeros());
        let found = course.subject.T_linear_tetrahedron(&t.scatter(&entries), &t.element, 30.0, 0.5)?;
        near_number("T with one moving vertex (consistent mass)", found, 0.5 * 30.0 * 0.5 / 10.0 * 4.0, 1e-13)?;
    }
    Ok(())
}

fn opposite_velocities_of_two_vertices_subtract(course: &Course) -> Outcome {
    // ∫ (φ_a − φ_b)² = volume (1/10 + 1/10 − 2/20).
    let t = Tetrahedron::new([5, 1, 8, 2], &Matrix3::identity(), &Vector3::zeros());
    let mut entries = DVector::zeros(12);
    (entries[2], entries[8]) = (1.0, -1.0);
    let found = course.subject.T_linear_tetrahedron(&t.scatter(&entries), &t.element, 30.0, 0.5)?;
    near_number("T with two opposite velocities", found, 0.5 * 30.0 * 0.5 / 10.0, 1e-13)
}

fn it_is_the_integral_of_half_density_times_speed_squared(course: &Course) -> Outcome {
    // Four points with these weights integrate every quadratic exactly over a tetrahedron.
    let (near_vertex, elsewhere) = ((5.0 + 3.0 * 5f64.sqrt()) / 20.0, (5.0 - 5f64.sqrt()) / 20.0);
    for_all(course.seed, (tetrahedron(), deformation(), vector(-3.0..3.0)), |(t, slope, shift)| {
        let shift = shift * t.size();
        let speeds = (0..4).map(|a| {
            let point: Vector3<f64> = t.X().iter().sum::<Vector3<f64>>() * elsewhere;
            (slope * (point + t.X()[a] * (near_vertex - elsewhere)) + shift).norm_squared()
        });
        let expected = 0.5 * 700.0 * t.volume * speeds.sum::<f64>() / 4.0;
        let scale = (0..4).map(|a| (slope * t.X()[a] + shift).norm_squared()).sum::<f64>() * 700.0 * t.volume;
        near_number(
            "T of a linear field of velocities",
            energy(course, &t, &slope, &shift, 700.0)?,
            expected,
            1e-12 * scale,
        )
    })
}

fn the_given_volume_is_used(course: &Course) -> Outcome {
    let t = Tetrahedron::unit();
    let found =
        course.subject.T_linear_tetrahedron(&t.moved(&Matrix3::zeros(), &Vector3::y()), &t.element, 2.0, 5.0)?;
    with_input(
        "ρ = 2 kg/m³, a volume of 5 m³, all vertices at 1 m/s",
        near_number("T = ½ ρ volume |v|² with the given volume", found, 5.0, 1e-13),
    )
}

fn the_order_of_the_vertices_does_not_matter(course: &Course) -> Outcome {
    for_some(course.seed, (tetrahedron(), deformation()), |(t, slope)| {
        let expected = energy(course, &t, &slope, &Vector3::zeros(), 1.0)?;
        for order in orders() {
            let found = energy(course, &t.reordered(order), &slope, &Vector3::zeros(), 1.0)?;
            near_number("T of the same element", found, expected, 1e-13 * expected)?;
        }
        holds("a moving element has kinetic energy", expected > 0.0)
    })
}
