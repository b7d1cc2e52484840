//! To do: the values of the four linear shape functions at a point. Read include-docs/phi_linear_tetrahedron.md.

use nalgebra::{Matrix3, Vector3, Vector4};

use super::meshes::{Tetrahedron, orders};
use super::outcome::{Outcome, near, near_number};
use super::random::{for_all, for_some, tetrahedron, vector};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    the_unit_tetrahedron_gives_one_minus_the_sum_and_the_coordinates,
    a_tetrahedron_without_symmetry_agrees_with_a_calculation_by_hand,
    each_function_is_one_at_its_own_vertex_and_zero_at_the_others,
    the_values_sum_to_one_inside_and_outside,
    blending_the_vertices_gives_the_point_back,
    a_point_outside_keeps_its_negative_value,
    on_faces_and_edges_the_functions_of_the_other_vertices_vanish,
    entries_follow_the_order_of_the_element,
    far_from_the_origin_no_digits_are_lost,
    millimetres_and_kilometres_give_the_same_values,
];

fn phi(course: &Course, t: &Tetrahedron, x: &Vector3<f64>) -> Answer<Vector4<f64>> {
    course.subject.phi_linear_tetrahedron(&t.V, &t.element, x)
}

fn the_unit_tetrahedron_gives_one_minus_the_sum_and_the_coordinates(course: &Course) -> Outcome {
    let expected = Vector4::new(0.4, 0.1, 0.2, 0.3);
    let rule = "in the unit tetrahedron, one minus the sum of the coordinates, then the coordinates";
    near(rule, &phi(course, &Tetrahedron::unit(), &Vector3::new(0.1, 0.2, 0.3))?, &expected, 1e-14)
}

fn a_tetrahedron_without_symmetry_agrees_with_a_calculation_by_hand(course: &Course) -> Outcome {
    // Edges (2, 0, 0), (1, 3, 0) and (1, 1, 4) from vertex (1, 1, 1): solve from the last coordinate upwards.
    let shape = Matrix3::new(2.0, 1.0, 1.0, 0.0, 3.0, 1.0, 0.0, 0.0, 4.0);
    let t = Tetrahedron::new([4, 2, 7, 0], &shape, &Vector3::repeat(1.0));
    let x = Vector3::new(2.0, 2.0, 2.0);
    let (phi3, phi2) = (0.25, (1.0 - 0.25) / 3.0);
    let phi1 = (1.0 - phi2 - phi3) / 2.0;
    let expected = Vector4::new(1.0 - phi1 - phi2 - phi3, phi1, phi2, phi3);
    near("edges belong in the columns of the matrix", &phi(course, &t, &x)?, &expected, 1e-14)
}

fn each_function_is_one_at_its_own_vertex_and_zero_at_the_others(course: &Course) -> Outcome {
    for_all(course.seed, tetrahedron(), |t| {
        for a in 0..4 {
            let expected = Vector4::from_fn(|row, _| if row == a { 1.0 } else { 0.0 });
            near("phi at a vertex", &phi(course, &t, &t.X()[a])?, &expected, 1e-12 * t.size() / t.height())?;
        }
        Ok(())
    })
}

fn the_values_sum_to_one_inside_and_outside(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), vector(-5.0..5.0)), |(t, x)| {
        let values = phi(course, &t, &(x * t.size()))?;
        near_number("the sum of the four values", values.sum(), 1.0, 1e-12 * t.size() / t.height())
    })
}

fn blending_the_vertices_gives_the_point_back(course: &Course) -> Outcome {
    for_all(course.seed, (tetrahedron(), vector(-1.0..1.0)), |(t, weights)| {
        let X = t.X();
        let x = X[0] + (X[1] - X[0]) * weights.x + (X[2] - X[0]) * weights.y + (X[3] - X[0]) * weights.z;
        let values = phi(course, &t, &x)?;
        let expected = Vector4::new(1.0 - weights.sum(), weights.x, weights.y, weights.z);
        near("the weights of the combination of the vertices", &values, &expected, 1e-12 * t.size() / t.height())?;
        let blend: Vector3<f64> = (0..4).map(|a| X[a] * values[a]).sum();
        near("the sum of phi_a X_a must be the point", &blend, &x, 1e-11 * t.size())
    })
}

fn a_point_outside_keeps_its_negative_value(course: &Course) -> Outcome {
    let x = Vector3::new(-0.5, 2.0, 0.25);
    let expected = Vector4::new(-0.75, -0.5, 2.0, 0.25);
    near("nothing is clamped outside the element", &phi(course, &Tetrahedron::unit(), &x)?, &expected, 1e-14)
}

fn on_faces_and_edges_the_functions_of_the_other_vertices_vanish(course: &Course) -> Outcome {
    let t = Tetrahedron::new([1, 5, 3, 8], &Matrix3::new(1.0, 0.5, 0.0, 0.0, 2.0, 0.5, 0.5, 0.0, 1.0), &Vector3::x());
    let X = t.X();
    let on_edge = phi(course, &t, &((X[1] + X[3]) / 2.0))?;
    near("the middle of an edge", &on_edge, &Vector4::new(0.0, 0.5, 0.0, 0.5), 1e-14)?;
    let on_face = phi(course, &t, &((X[0] + X[1] + X[2] * 2.0) / 4.0))?;
    near("a point on a face", &on_face, &Vector4::new(0.25, 0.25, 0.5, 0.0), 1e-14)
}

fn entries_follow_the_order_of_the_element(course: &Course) -> Outcome {
    for_some(course.seed, (tetrahedron(), vector(-1.0..1.0)), |(t, x)| {
        let (x, allowed) = (x * t.size(), 1e-11 * t.size() / t.height());
        let values = phi(course, &t, &x)?;
        for order in orders() {
            let expected = Vector4::from(order.map(|a| values[a]));
            near("entry i belongs to element[i]", &phi(course, &t.reordered(order), &x)?, &expected, allowed)?;
        }
        Ok(())
    })
}

fn far_from_the_origin_no_digits_are_lost(course: &Course) -> Outcome {
    let offset = Vector3::new(1048576.0, -2097152.0, 524288.0); // powers of two, so that the sums below are exact
    let t = Tetrahedron::new([3, 0, 6, 2], &Matrix3::identity(), &offset);
    let values = phi(course, &t, &(offset + Vector3::new(0.125, 0.25, 0.5)))?;
    near("far from the origin; subtract positions first", &values, &Vector4::new(0.125, 0.125, 0.25, 0.5), 1e-9)
}

fn millimetres_and_kilometres_give_the_same_values(course: &Course) -> Outcome {
    for size in [1e-9, 1e-3, 1e3, 1e9] {
        let t = Tetrahedron::new([0, 1, 2, 3], &(Matrix3::identity() * size), &Vector3::zeros());
        let values = phi(course, &t, &(Vector3::new(0.1, 0.2, 0.3) * size))?;
        near("phi has no unit", &values, &Vector4::new(0.4, 0.1, 0.2, 0.3), 1e-14)?;
    }
    Ok(())
}
