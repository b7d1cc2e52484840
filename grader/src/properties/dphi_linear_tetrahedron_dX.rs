//! To do: the gradients of the four shape functions. Read include-docs/dphi_linear_tetrahedron_dX.md.

use nalgebra::{DVector, Matrix3, Matrix4x3, RowVector3, Vector3};

use super::finite_differences::jacobian;
use super::meshes::{Tetrahedron, orders};
use super::outcome::{Outcome, near, waits};
use super::random::{deformation, for_all, for_some, tetrahedron, vector};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    the_unit_tetrahedron_gives_minus_ones_above_the_identity,
    a_tetrahedron_without_symmetry_agrees_with_a_calculation_by_hand,
    the_gradients_are_those_of_the_shape_functions,
    the_rows_sum_to_zero,
    every_linear_field_is_differentiated_exactly,
    the_answer_is_the_same_at_every_point,
    rows_follow_the_order_of_the_element,
    an_element_twice_as_large_has_gradients_half_as_large,
    far_from_the_origin_no_digits_are_lost,
];

fn dphi(course: &Course, t: &Tetrahedron, X: &Vector3<f64>) -> Answer<Matrix4x3<f64>> {
    course.subject.dphi_linear_tetrahedron_dX(&t.V, &t.element, X)
}

fn middle(t: &Tetrahedron) -> Vector3<f64> {
    t.X().into_iter().sum::<Vector3<f64>>() / 4.0
}

fn the_unit_tetrahedron_gives_minus_ones_above_the_identity(course: &Course) -> Outcome {
    let expected = Matrix4x3::new(-1.0, -1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    near("row i belongs to element[i]", &dphi(course, &Tetrahedron::unit(), &Vector3::repeat(0.25))?, &expected, 1e-14)
}

fn a_tetrahedron_without_symmetry_agrees_with_a_calculation_by_hand(course: &Course) -> Outcome {
    // x = 2ξ + η + ζ, y = 3η + ζ, z = 4ζ, so ζ = z/4, η = (y − ζ)/3, ξ = (x − η − ζ)/2.
    let shape = Matrix3::new(2.0, 1.0, 1.0, 0.0, 3.0, 1.0, 0.0, 0.0, 4.0);
    let t = Tetrahedron::new([4, 2, 7, 0], &shape, &Vector3::repeat(1.0));
    let zeta = RowVector3::new(0.0, 0.0, 0.25);
    let eta = (RowVector3::new(0.0, 1.0, 0.0) - zeta) / 3.0;
    let xi = (RowVector3::new(1.0, 0.0, 0.0) - eta - zeta) / 2.0;
    let expected = Matrix4x3::from_rows(&[-(xi + eta + zeta), xi, eta, zeta]);
    near("mind rows and columns of the inverse", &dphi(course, &t, &middle(&t))?, &expected, 1e-14)
}

fn the_gradients_are_those_of_the_shape_functions(course: &Course) -> Outcome {
    for_some(course.seed, (tetrahedron(), vector(-1.0..1.0)), |(t, X)| {
        let X = X * t.size();
        let values = |X: &DVector<f64>| {
            let x = Vector3::new(X[0], X[1], X[2]);
            let phi =
                course.trusted.phi_linear_tetrahedron(&t.V, &t.element, &x).map_err(waits("phi_linear_tetrahedron"))?;
            Ok(DVector::from_column_slice(phi.as_slice()))
        };
        let expected = jacobian(values, &DVector::from_column_slice(X.as_slice()), t.size())?;
        let gradients = dphi(course, &t, &X)?;
        near("differences of phi_linear_tetrahedron", &gradients, &expected, 1e-10 * t.size() / t.height().powi(2))
    })
}

fn the_rows_sum_to_zero(course: &Course) -> Outcome {
    for_all(course.seed, tetrahedron(), |t| {
        let sum = dphi(course, &t, &middle(&t))?.row_sum();
        near("the functions sum to one, their gradients to", &sum, &RowVector3::zeros(), 1e-13 / t.height())
    })
}

fn every_linear_field_is_differentiated_exactly(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), deformation(), vector(-1.0..1.0)), |(t, slope, value)| {
        // Σ u_a ⊗ ∇φ_a for u(X) = slope X + value at the vertices.
        let at_vertices = t.X().map(|X| slope * (X - t.X()[0]) + value);
        let gradients = dphi(course, &t, &middle(&t))?;
        let gradient = Matrix3::from_fn(|i, j| (0..4).map(|a| at_vertices[a][i] * gradients[(a, j)]).sum());
        near("the gradient of a linear field", &gradient, &slope, 1e-11 * t.size().max(1.0) / t.height().min(1.0))
    })
}

fn the_answer_is_the_same_at_every_point(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), vector(-9.0..9.0)), |(t, X)| {
        let allowed = 1e-13 / t.height();
        near(
            "linear functions have constant gradients",
            &dphi(course, &t, &X)?,
            &dphi(course, &t, &middle(&t))?,
            allowed,
        )
    })
}

fn rows_follow_the_order_of_the_element(course: &Course) -> Outcome {
    for_some(course.seed, tetrahedron(), |t| {
        let rows = dphi(course, &t, &middle(&t))?;
        for order in orders() {
            let expected = Matrix4x3::from_rows(&order.map(|a| rows.row(a).into_owned()));
            let reordered = t.reordered(order);
            near(
                "row i belongs to element[i]",
                &dphi(course, &reordered, &middle(&t))?,
                &expected,
                1e-11 / t.height(),
            )?;
        }
        Ok(())
    })
}

fn an_element_twice_as_large_has_gradients_half_as_large(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), -3.0..3.0), |(t, power)| {
        let factor = 10f64.powf(power);
        let larger = Tetrahedron { V: t.V.iter().map(|X| X * factor).collect(), ..t.clone() };
        let expected = dphi(course, &t, &middle(&t))? / factor;
        let allowed = 1e-11 / (t.height() * factor);
        near("gradients have the unit 1/m", &dphi(course, &larger, &(middle(&t) * factor))?, &expected, allowed)
    })
}

fn far_from_the_origin_no_digits_are_lost(course: &Course) -> Outcome {
    let shape = Matrix3::new(1.0, 0.5, 0.0, 0.0, 2.0, 0.5, 0.5, 0.0, 1.0);
    let here = Tetrahedron::new([3, 0, 6, 2], &shape, &Vector3::zeros());
    let far = Tetrahedron::new([3, 0, 6, 2], &shape, &Vector3::new(1048576.0, -2097152.0, 524288.0));
    near(
        "far from the origin; use edges",
        &dphi(course, &far, &middle(&far))?,
        &dphi(course, &here, &middle(&here))?,
        1e-9,
    )
}
