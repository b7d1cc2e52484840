//! To do: the gradient of a spring's energy. Read include-docs/dV_spring_particle_particle_dq.md.

use nalgebra::{DVector, SVector, Vector3};

use super::finite_differences::gradient;
use super::outcome::{Outcome, near, waits};
use super::random::{for_all, for_some, vector};
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_spring_agrees_with_a_calculation_by_hand,
    it_is_the_gradient_of_the_energy,
    a_spring_without_rest_length_is_linear,
    a_spring_of_zero_length_has_a_zero_gradient,
    a_very_short_spring_still_pushes,
];

fn a_spring_agrees_with_a_calculation_by_hand(course: &Course) -> Outcome {
    // 7 m apart along (2, 3, 6)/7, rest length 5 m: a tension of 20 N/m · 2 m.
    let (q0, q1) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(3.0, 5.0, 9.0));
    let pull = Vector3::new(2.0, 3.0, 6.0) / 7.0 * 40.0;
    let expected = SVector::<f64, 6>::from([-pull.x, -pull.y, -pull.z, pull.x, pull.y, pull.z]);
    let found = course.subject.dV_spring_particle_particle_dq(&q0, &q1, 5.0, 20.0)?;
    near("+∂V/∂q, first q0's three entries, then q1's", &found, &expected, 1e-12)
}

fn it_is_the_gradient_of_the_energy(course: &Course) -> Outcome {
    for_some(course.seed, (vector(-2.0..2.0), vector(0.3..2.0), 0.0..3.0, 1.0..1e5), |(q0, d, l0, stiffness)| {
        let energy = |q: &DVector<f64>| {
            let (q0, q1) = (Vector3::new(q[0], q[1], q[2]), Vector3::new(q[3], q[4], q[5]));
            let V = course.trusted.V_spring_particle_particle(&q0, &q1, l0, stiffness);
            V.map_err(waits("V_spring_particle_particle"))
        };
        let q1 = q0 + d;
        let q = DVector::from_column_slice(&[q0.x, q0.y, q0.z, q1.x, q1.y, q1.z]);
        let expected = gradient(energy, &q, 0.02)?;
        let found = course.subject.dV_spring_particle_particle_dq(&q0, &q1, l0, stiffness)?;
        near("differences of V_spring_particle_particle", &found, &expected, 1e-9 * stiffness)
    })
}

fn a_spring_without_rest_length_is_linear(course: &Course) -> Outcome {
    for_all(course.seed, (vector(-2.0..2.0), vector(-2.0..2.0)), |(q0, d)| {
        let found = course.subject.dV_spring_particle_particle_dq(&q0, &(q0 + d), 0.0, 8.0)?;
        let expected = SVector::<f64, 6>::from_fn(|row, _| if row < 3 { -8.0 * d[row] } else { 8.0 * d[row - 3] });
        near("k (q1 − q0) for l0 = 0", &found, &expected, 1e-13)
    })
}

fn a_spring_of_zero_length_has_a_zero_gradient(course: &Course) -> Outcome {
    let q = Vector3::new(1.0, 2.0, 3.0);
    for l0 in [2.0, 0.0] {
        let found = course.subject.dV_spring_particle_particle_dq(&q, &q, l0, 3.0)?;
        near("zero, never NaN, at zero length", &found, &SVector::<f64, 6>::zeros(), 0.0)?;
    }
    Ok(())
}

fn a_very_short_spring_still_pushes(course: &Course) -> Outcome {
    // The square of the shortest one is still far from the smallest number.
    for_all(course.seed, (vector(0.3..2.0), -100.0..0.0, 0.1..2.0f64), |(d, power, l0)| {
        let (direction, length) = (d.normalize(), 10f64.powf(power));
        let gradient = |length: f64, l0: f64| {
            course.subject.dV_spring_particle_particle_dq(&Vector3::zeros(), &(direction * length), l0, 3.0)
        };
        // A spring of ordinary length with the same elongation.
        let (found, expected) = (gradient(length, l0)?, gradient(1.0, l0 + (1.0 - length))?);
        near("only a length of exactly zero has no direction", &found, &expected, 1e-14 * (1.0 + l0) * 10.0)?;
        let (found, expected) = (gradient(length, 0.0)?, gradient(1.0, 0.0)? * length);
        near("a spring without rest length is linear, however short", &found, &expected, 1e-13 * length)
    })
}
