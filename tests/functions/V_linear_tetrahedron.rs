//! To do: the elastic energy of one element. Read include-docs/V_linear_tetrahedron.md.

use finite_elements_3d::V_linear_tetrahedron;
use nalgebra::{Matrix3, Vector3};

use crate::meshes::{Tetrahedron, orders};
use crate::outcome::{Outcome, for_all, near_number};
use crate::random::{constants, deformed_tetrahedron, rotation, stretches, tetrahedron, vector};
use crate::scales::energy_terms;

/// Energy of the element after X → F X + shift.
fn energy(t: &Tetrahedron, F: &Matrix3<f64>, shift: &Vector3<f64>, C: f64, D: f64) -> f64 {
    V_linear_tetrahedron(&t.moved(F, shift), &t.V, &t.element, t.volume, C, D)
}

/// Round-off: F comes from positions, whose digits count against the lowest height of the element.
fn allowed(t: &Tetrahedron, F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    1e-11 * t.volume * energy_terms(F, C, D) * t.size() / t.height()
}

#[test]
fn an_element_that_only_moves_stores_nothing() -> Outcome {
    for_all((tetrahedron(), rotation(), vector(-3.0..3.0), constants()), |(t, R, shift, (C, D))| {
        let found = energy(&t, &R, &(shift * t.size()), C, D);
        near_number("V of a moved and rotated element", found, 0.0, allowed(&t, &R, C, D))
    })
}

#[test]
fn uniform_stretch_costs_volume_times_d() -> Outcome {
    for_all((tetrahedron(), -1.0..1.0, constants()), |(t, power, (C, D))| {
        let (s, F) = (f64::exp(power), Matrix3::identity() * f64::exp(power));
        let expected = t.volume * D * (s.powi(3) - 1.0).powi(2);
        let found = energy(&t, &F, &Vector3::zeros(), C, D);
        near_number("V(s X) = volume · D (s³ − 1)²", found, expected, allowed(&t, &F, C, D))
    })
}

#[test]
fn simple_shear_costs_volume_times_c() -> Outcome {
    for_all((tetrahedron(), -2.0..2.0, constants()), |(t, gamma, (C, D))| {
        for (i, j) in [(0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)] {
            let mut F = Matrix3::identity();
            F[(i, j)] = gamma;
            let expected = t.volume * C * gamma * gamma;
            let found = energy(&t, &F, &Vector3::zeros(), C, D);
            near_number("V of a simple shear = volume · C γ²", found, expected, allowed(&t, &F, C, D))?;
        }
        Ok(())
    })
}

#[test]
fn any_stretch_in_any_frame_has_the_energy_of_its_stretches() -> Outcome {
    let inputs = (tetrahedron(), rotation(), stretches(), rotation(), constants());
    for_all(inputs, |(t, U, sigma, W, (C, D))| {
        let F = U * Matrix3::from_diagonal(&sigma) * W.transpose();
        let J = sigma.product();
        let density = C * (sigma.norm_squared() / (J * J).cbrt() - 3.0) + D * (J - 1.0).powi(2);
        let found = energy(&t, &F, &Vector3::zeros(), C, D);
        near_number("V = volume · psi(F)", found, t.volume * density, allowed(&t, &F, C, D))
    })
}

#[test]
fn the_volume_that_is_given_counts() -> Outcome {
    let t = Tetrahedron::unit();
    let q = t.moved(&(Matrix3::identity() * 2.0), &Vector3::zeros());
    let found = V_linear_tetrahedron(&q, &t.V, &t.element, 3.0, 1.0, 1.0);
    near_number("V(2 X) = volume · D · 49 with a volume of 3", found, 147.0, 1e-11)
}

#[test]
fn an_element_turned_inside_out_costs_infinitely_much() -> Outcome {
    for_all((deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        near_number("V of a mirrored element", energy(&t, &-F, &shift, C, D), f64::INFINITY, 0.0)
    })
}

#[test]
fn the_order_of_the_vertices_does_not_matter() -> Outcome {
    for_all((deformed_tetrahedron(), constants()), |((t, F, shift), (C, D))| {
        let expected = energy(&t, &F, &shift, C, D);
        for order in orders() {
            let found = energy(&t.reordered(order), &F, &shift, C, D);
            near_number("V of the same element", found, expected, 10.0 * allowed(&t, &F, C, D))?;
        }
        Ok(())
    })
}

#[test]
fn an_element_far_from_the_origin_stores_the_same() -> Outcome {
    let offset = Vector3::new(1048576.0, -2097152.0, 524288.0);
    let t = Tetrahedron::new([3, 0, 6, 2], &Matrix3::identity(), &offset);
    let found = energy(&t, &(Matrix3::identity() * 2.0), &Vector3::zeros(), 1.0, 1.0);
    near_number("V(2 X), 1000 km away", found, t.volume * 49.0, 1e-6)
}
