//! To do: integration over an element with one point. Read include-docs/quadrature_single_point.md.

use std::cell::Cell;

use nalgebra::{DVector, Matrix3, Vector3};

use super::meshes::Tetrahedron;
use super::outcome::{Outcome, holds, near, near_number, with_input};
use super::random::{for_all, tetrahedron, vector};
use super::{Check, Course};
use crate::implementation::{Answer, Trouble};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_constant_integrates_to_itself_times_the_volume,
    the_given_volume_is_used,
    linear_functions_are_integrated_exactly,
    the_point_is_the_undeformed_centroid,
    a_quadratic_is_taken_at_the_centroid,
    the_integrand_is_evaluated_once,
    vectors_and_matrices_are_integrated_like_numbers,
];

/// The integral of numbers, passed as vectors of one entry.
fn number(course: &Course, t: &Tetrahedron, volume: f64, integrand: &dyn Fn(&Vector3<f64>) -> f64) -> Answer<f64> {
    let of_one = |X: &Vector3<f64>| DVector::from_element(1, integrand(X));
    let integral = course.subject.quadrature_single_point(&t.V, &t.element, volume, &of_one)?;
    if let [integral] = integral.as_slice() { Ok(*integral) } else { Err(Trouble::Malformed) }
}

fn a_constant_integrates_to_itself_times_the_volume(course: &Course) -> Outcome {
    for_all(course.seed, tetrahedron(), |t| {
        let integral = number(course, &t, t.volume, &|_| 3.0)?;
        near_number("a constant integrates to itself times the volume", integral, 3.0 * t.volume, 1e-14 * t.volume)
    })
}

fn the_given_volume_is_used(course: &Course) -> Outcome {
    let t = Tetrahedron::unit();
    let integral = number(course, &t, 7.0, &|_| 2.0)?;
    let rule = "the given volume is used, whatever the vertices are";
    with_input("the constant 2, a volume of 7 m³", near_number(rule, integral, 14.0, 1e-14))
}

fn linear_functions_are_integrated_exactly(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), vector(-3.0..3.0)), |(t, slope)| {
        let exact = t.X().iter().map(|X| slope.dot(X) + t.size()).sum::<f64>() / 4.0 * t.volume;
        let integral = number(course, &t, t.volume, &|X| slope.dot(X) + t.size())?;
        let scale = t.X().iter().map(|X| X.norm()).sum::<f64>() * slope.norm() + t.size();
        near_number("mean of the vertices' values times volume", integral, exact, 1e-13 * scale * t.volume)
    })
}

fn the_point_is_the_undeformed_centroid(course: &Course) -> Outcome {
    for_all(course.seed, tetrahedron(), |t| {
        let centroid = t.X().iter().sum::<Vector3<f64>>() / 4.0;
        let seen = Cell::new(Vector3::repeat(f64::NAN));
        number(course, &t, t.volume, &|X| {
            seen.set(*X);
            0.0
        })?;
        let scale = t.X().iter().map(|X| X.norm()).sum::<f64>();
        near("the point at which the integrand is evaluated", &seen.get(), &centroid, 1e-14 * scale)
    })
}

fn a_quadratic_is_taken_at_the_centroid(course: &Course) -> Outcome {
    let t = Tetrahedron::unit();
    let integral = number(course, &t, t.volume, &|X| X.norm_squared())?;
    let rule = "a quadratic counts with its value at the centroid";
    with_input("|X|² over the unit tetrahedron", near_number(rule, integral, 3.0 / 16.0 / 6.0, 1e-15))
}

fn the_integrand_is_evaluated_once(course: &Course) -> Outcome {
    let calls = Cell::new(0);
    let t = Tetrahedron::unit();
    number(course, &t, t.volume, &|_| {
        calls.set(calls.get() + 1);
        1.0
    })?;
    holds("one point, so one call of the integrand", calls.get() == 1)
}

fn vectors_and_matrices_are_integrated_like_numbers(course: &Course) -> Outcome {
    let t = Tetrahedron::new([8, 3, 4, 6], &Matrix3::identity(), &Vector3::new(1.0, 2.0, 3.0));
    let integral = |integrand: &dyn Fn(&Vector3<f64>) -> DVector<f64>| {
        course.subject.quadrature_single_point(&t.V, &t.element, 2.0, integrand)
    };
    let vector = integral(&|X| DVector::from_column_slice(X.as_slice()))?;
    near("the integral of X", &vector, &Vector3::new(2.5, 4.5, 6.5), 1e-14)?;
    for (size, rule) in [(12, "twelve entries"), (144, "as many entries as a 12×12 matrix has")] {
        let entry = |k: usize| 1.5 + k as f64;
        let found = integral(&|_| DVector::from_fn(size, |k, _| entry(k)))?;
        near(rule, &found, &DVector::from_fn(size, |k, _| 2.0 * entry(k)), 1e-12)?;
    }
    Ok(())
}
