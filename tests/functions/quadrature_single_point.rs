//! To do: integration over an element with one point. Read include-docs/quadrature_single_point.md.

use std::cell::Cell;

use finite_elements_3d::quadrature_single_point;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use crate::meshes::Tetrahedron;
use crate::outcome::{Outcome, for_all, holds, near, near_number};
use crate::random::{tetrahedron, vector};

#[test]
fn a_constant_integrates_to_itself_times_the_volume() -> Outcome {
    for_all(tetrahedron(), |t| {
        let integral = quadrature_single_point(&t.V, &t.element, t.volume, |_| 3.0);
        near_number("the integral of 3", integral, 3.0 * t.volume, 1e-14 * t.volume)
    })
}

#[test]
fn the_volume_that_is_given_counts() -> Outcome {
    let t = Tetrahedron::unit();
    let integral = quadrature_single_point(&t.V, &t.element, 7.0, |_| 2.0);
    near_number("2 over a volume of 7, whatever the vertices are", integral, 14.0, 1e-14)
}

#[test]
fn linear_functions_are_integrated_exactly() -> Outcome {
    for_all((tetrahedron(), vector(-3.0..3.0)), |(t, slope)| {
        let exact = t.X().iter().map(|X| slope.dot(X) + t.size()).sum::<f64>() / 4.0 * t.volume;
        let integral = quadrature_single_point(&t.V, &t.element, t.volume, |X| slope.dot(X) + t.size());
        let scale = t.X().iter().map(|X| X.norm()).sum::<f64>() * slope.norm() + t.size();
        near_number("mean of the vertices' values times volume", integral, exact, 1e-13 * scale * t.volume)
    })
}

#[test]
fn the_point_is_the_undeformed_centroid() -> Outcome {
    for_all(tetrahedron(), |t| {
        let centroid = t.X().iter().sum::<Vector3<f64>>() / 4.0;
        let seen = Cell::new(Vector3::zeros());
        quadrature_single_point(&t.V, &t.element, t.volume, |X| {
            seen.set(*X);
            0.0
        });
        let scale = t.X().iter().map(|X| X.norm()).sum::<f64>();
        near("the point at which the integrand is asked", &seen.get(), &centroid, 1e-14 * scale)
    })
}

#[test]
fn a_quadratic_is_taken_at_the_centroid() -> Outcome {
    let t = Tetrahedron::unit();
    let integral = quadrature_single_point(&t.V, &t.element, t.volume, |X| X.norm_squared());
    near_number("|X|² at (¼, ¼, ¼) times 1/6", integral, 3.0 / 16.0 / 6.0, 1e-15)
}

#[test]
fn the_integrand_is_asked_once() -> Outcome {
    let calls = Cell::new(0);
    let t = Tetrahedron::unit();
    quadrature_single_point(&t.V, &t.element, t.volume, |_| {
        calls.set(calls.get() + 1);
        1.0
    });
    holds("one point, so one call of the integrand", calls.get() == 1)
}

#[test]
fn vectors_and_matrices_are_integrated_like_numbers() -> Outcome {
    let t = Tetrahedron::new([8, 3, 4, 6], &Matrix3::identity(), &Vector3::new(1.0, 2.0, 3.0));
    let vector = quadrature_single_point(&t.V, &t.element, 2.0, |X| *X);
    near("the integral of X", &vector, &Vector3::new(2.5, 4.5, 6.5), 1e-14)?;
    let twelve = quadrature_single_point(&t.V, &t.element, 2.0, |_| SVector::<f64, 12>::repeat(1.5));
    near("twelve entries", &twelve, &SVector::<f64, 12>::repeat(3.0), 1e-14)?;
    let matrix = quadrature_single_point(&t.V, &t.element, 2.0, |_| SMatrix::<f64, 12, 12>::identity());
    near("a 12×12 matrix", &matrix, &(SMatrix::<f64, 12, 12>::identity() * 2.0), 1e-14)
}
