//! To do: the first Piola–Kirchhoff stress ∂ψ/∂F. Read include-docs/dpsi_neo_hookean_dF.md.

use nalgebra::{DVector, Matrix3, SVector, Vector3};

use super::finite_differences::gradient;
use super::outcome::{Outcome, near, near_number, waits};
use super::random::{constants, deformation, for_all, for_some, rotation, stretches};
use super::scales::{energy_terms, smallest_stretch, stress_terms};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    entry_3i_plus_j_is_the_derivative_by_row_i_column_j,
    simple_shear_has_the_stress_of_the_closed_form,
    uniform_stretch_has_the_pressure_of_the_closed_form,
    a_bar_with_free_sides_has_the_stress_of_the_closed_form,
    a_body_at_rest_or_rotated_has_no_stress,
    principal_stretches_have_principal_stresses,
    the_stress_turns_with_the_body,
    moments_balance,
    the_first_term_depends_on_the_shape_only,
    small_strains_follow_hookes_law,
];

/// The nine entries as a matrix.
fn P(course: &Course, F: &Matrix3<f64>, C: f64, D: f64) -> Answer<Matrix3<f64>> {
    Ok(Matrix3::from_row_slice(course.subject.dpsi_neo_hookean_dF(F, C, D)?.as_slice()))
}

fn rows_of(F: &Matrix3<f64>) -> DVector<f64> {
    DVector::from_fn(9, |entry, _| F[(entry / 3, entry % 3)])
}

fn entry_3i_plus_j_is_the_derivative_by_row_i_column_j(course: &Course) -> Outcome {
    for_some(course.seed, (deformation(), constants()), |(F, (C, D))| {
        for (C, D, rule) in [(C, 0.0, "C's term: differences of psi"), (0.0, D, "D's term: differences of psi")] {
            let psi = |f: &DVector<f64>| {
                let F = Matrix3::from_row_slice(f.as_slice());
                course.trusted.psi_neo_hookean(&F, C, D).map_err(waits("psi_neo_hookean"))
            };
            let expected = gradient(psi, &rows_of(&F), 0.05 * smallest_stretch(&F))?;
            near(rule, &course.subject.dpsi_neo_hookean_dF(&F, C, D)?, &expected, 1e-10 * stress_terms(&F, C, D))?;
        }
        Ok(())
    })
}

fn simple_shear_has_the_stress_of_the_closed_form(course: &Course) -> Outcome {
    // ψ's first term for F = 1 + γ e_0 ⊗ e_1: P = 2C (F − (1 + γ²/3) F^(−T)), with F^(−T) = 1 − γ e_1 ⊗ e_0.
    let (gamma, C, D) = (0.6, 5.0, 11.0);
    let third = 1.0 + gamma * gamma / 3.0;
    let diagonal = 2.0 * C * (1.0 - third);
    let (p01, p10) = (2.0 * C * gamma, 2.0 * C * gamma * third);
    let expected = SVector::<f64, 9>::from([diagonal, p01, 0.0, p10, diagonal, 0.0, 0.0, 0.0, diagonal]);
    let F = Matrix3::new(1.0, gamma, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    near(
        "flatten row by row: entry 1 is P_01, entry 3 is P_10",
        &course.subject.dpsi_neo_hookean_dF(&F, C, D)?,
        &expected,
        1e-13,
    )
}

fn uniform_stretch_has_the_pressure_of_the_closed_form(course: &Course) -> Outcome {
    for_all(course.seed, (-1.0..1.0, constants()), |(power, (C, D))| {
        let s = f64::exp(power);
        let (F, pressure) = (Matrix3::identity() * s, 2.0 * D * (s.powi(3) - 1.0) * s * s);
        let allowed = 1e-12 * stress_terms(&F, C, D);
        near("P(s 1) = 2 D (s³ − 1) s² 1", &P(course, &F, C, D)?, &(Matrix3::identity() * pressure), allowed)
    })
}

fn a_bar_with_free_sides_has_the_stress_of_the_closed_form(course: &Course) -> Outcome {
    let (C, D) = (2e5, 7e5);
    for stretch in [0.4, 0.8, 1.3, 2.5] {
        // The lateral stretch a is where the stress on the sides vanishes; bisection in the closed form of numbers.
        let on_sides = |a: f64| {
            let J: f64 = stretch * a * a;
            2.0 * C / 3.0 * J.powf(-2.0 / 3.0) * (a * a - stretch * stretch) + 2.0 * D * (J - 1.0) * J
        };
        let (mut low, mut high) = (0.1, 5.0);
        for _ in 0..80 {
            let middle = (low + high) / 2.0;
            if on_sides(middle) < 0.0 { low = middle } else { high = middle }
        }
        let J = stretch * low * low;
        let pull = 2.0 * C / stretch * J.powf(-2.0 / 3.0) * (stretch * stretch - low * low);
        let F = Matrix3::from_diagonal(&Vector3::new(stretch, low, low));
        let expected = Matrix3::from_diagonal(&Vector3::new(pull, 0.0, 0.0));
        near("uniaxial stretch", &P(course, &F, C, D)?, &expected, 1e-12 * stress_terms(&F, C, D))?;
    }
    Ok(())
}

fn a_body_at_rest_or_rotated_has_no_stress(course: &Course) -> Outcome {
    for_all(course.seed, (rotation(), constants()), |(R, (C, D))| {
        near("P of a rotation", &P(course, &R, C, D)?, &Matrix3::zeros(), 1e-13 * (C + D))
    })
}

fn principal_stretches_have_principal_stresses(course: &Course) -> Outcome {
    for_all(course.seed, (rotation(), stretches(), rotation(), constants()), |(U, sigma, W, (C, D))| {
        let F = U * Matrix3::from_diagonal(&sigma) * W.transpose();
        let in_frame = P(course, &Matrix3::from_diagonal(&sigma), C, D)?;
        let allowed = 1e-11 * stress_terms(&F, C, D);
        near("P is diagonal for a diagonal F", &in_frame, &Matrix3::from_diagonal(&in_frame.diagonal()), allowed)?;
        near("P(U S Wᵀ) = U P(S) Wᵀ", &P(course, &F, C, D)?, &(U * in_frame * W.transpose()), allowed)
    })
}

fn the_stress_turns_with_the_body(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), rotation(), constants()), |(F, R, (C, D))| {
        let allowed = 1e-11 * stress_terms(&F, C, D);
        near("P(R F) = R P(F)", &P(course, &(R * F), C, D)?, &(R * P(course, &F, C, D)?), allowed)?;
        near(
            "P(F R) = P(F) R (the material has no direction)",
            &P(course, &(F * R), C, D)?,
            &(P(course, &F, C, D)? * R),
            allowed,
        )
    })
}

fn moments_balance(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), constants()), |(F, (C, D))| {
        let kirchhoff = P(course, &F, C, D)? * F.transpose();
        let allowed = 1e-11 * stress_terms(&F, C, D) * F.norm();
        near("P Fᵀ is symmetric", &kirchhoff, &kirchhoff.transpose(), allowed)
    })
}

fn the_first_term_depends_on_the_shape_only(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), constants()), |(F, (C, _))| {
        // Blowing up leaves it as it is, so the stress does no work against F itself.
        let work = P(course, &F, C, 0.0)?.component_mul(&F).sum();
        near_number("P · F with D = 0", work, 0.0, 1e-11 * energy_terms(&F, C, 0.0) * F.norm())
    })
}

fn small_strains_follow_hookes_law(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), constants()), |(direction, (C, D))| {
        let E = direction * 1e-7;
        let strain = (E + E.transpose()) / 2.0;
        let (shear, lambda) = (2.0 * C, 2.0 * D - 4.0 / 3.0 * C);
        let expected = strain * (2.0 * shear) + Matrix3::identity() * (lambda * strain.trace());
        let allowed = (C + D) * (1e-14 + 100.0 * E.norm_squared());
        near(
            "2 μ ε + λ tr ε 1 with μ = 2C and λ = 2D − 4C/3",
            &P(course, &(Matrix3::identity() + E), C, D)?,
            &expected,
            allowed,
        )
    })
}
