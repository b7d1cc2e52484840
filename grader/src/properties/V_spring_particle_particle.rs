//! To do: the energy of a spring. Read include-docs/V_spring_particle_particle.md.

use nalgebra::Vector3;

use super::outcome::{Outcome, near_number, with_input};
use super::random::{for_all, rotation, vector};
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    stretched_and_squeezed_springs_store_half_k_times_the_square,
    a_spring_of_zero_length_stores_the_energy_of_its_rest_length,
    only_the_distance_counts,
];

fn stretched_and_squeezed_springs_store_half_k_times_the_square(course: &Course) -> Outcome {
    let (q0, q1) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(3.0, 5.0, 9.0)); // 7 m apart
    for (l0, expected) in [(7.0, 0.0), (5.0, 40.0), (9.0, 40.0), (0.0, 490.0), (8.0, 10.0)] {
        let found = course.subject.V_spring_particle_particle(&q0, &q1, l0, 20.0)?;
        let rule = "the energy of a spring is half its stiffness times the square of its change of length";
        let input = format!("stiffness = 20 N/m, ends 7 m apart, l0 = {l0} m");
        with_input(&input, near_number(rule, found, expected, 1e-12))?;
    }
    Ok(())
}

fn a_spring_of_zero_length_stores_the_energy_of_its_rest_length(course: &Course) -> Outcome {
    let q = Vector3::new(1.0, 2.0, 3.0);
    let found = course.subject.V_spring_particle_particle(&q, &q, 2.0, 3.0)?;
    let rule = "a spring of zero length is compressed by its whole rest length";
    with_input("l0 = 2 m, stiffness = 3 N/m", near_number(rule, found, 6.0, 1e-15))?;
    near_number("a spring of zero length", course.subject.V_spring_particle_particle(&q, &q, 0.0, 3.0)?, 0.0, 0.0)
}

fn only_the_distance_counts(course: &Course) -> Outcome {
    let inputs = (vector(-2.0..2.0), vector(-2.0..2.0), vector(-9.0..9.0), rotation(), 0.0..3.0f64, 1.0..1e5f64);
    for_all(course.seed, inputs, |(q0, d, shift, R, l0, stiffness)| {
        let expected = 0.5 * stiffness * (d.norm() - l0).powi(2);
        let (q0, q1, allowed) = (R * q0 + shift, R * (q0 + d) + shift, 1e-12 * stiffness);
        near_number(
            "V of a moved spring",
            course.subject.V_spring_particle_particle(&q0, &q1, l0, stiffness)?,
            expected,
            allowed,
        )?;
        near_number(
            "V with the ends exchanged",
            course.subject.V_spring_particle_particle(&q1, &q0, l0, stiffness)?,
            expected,
            allowed,
        )
    })
}
