//! To do: the energy that a neo-Hookean material stores per undeformed volume. Read include-docs/psi_neo_hookean.md.

use nalgebra::{Matrix3, Vector3};

use super::double_double::DoubleDouble;
use super::outcome::{Outcome, holds, near_number, slack, with_input};
use super::random::{constants, deformation, for_all, rotation, stretches};
use super::scales::energy_terms;
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_body_at_rest_or_rotated_stores_no_energy,
    a_uniform_expansion_depends_on_d_alone,
    a_simple_shear_depends_on_c_alone,
    the_table_of_the_page_holds,
    the_energy_depends_on_the_principal_stretches_alone,
    known_stretches_agree_with_a_calculation_by_hand,
    one_term_depends_on_the_shape_alone_and_the_other_on_the_volume,
    the_energy_is_the_same_in_every_rotated_frame,
    the_energy_is_never_negative,
    flat_and_inverted_states_have_infinite_energy,
    strong_but_possible_states_have_a_finite_energy,
    near_rest_the_error_is_round_off_of_the_terms,
];

fn a_body_at_rest_or_rotated_stores_no_energy(course: &Course) -> Outcome {
    let at_rest = course.subject.psi_neo_hookean(&Matrix3::identity(), 2e5, 7e5)?;
    near_number("psi at rest (subtract 3 after the product)", at_rest, 0.0, 1e-14 * 9e5)?;
    for_all(course.seed, (rotation(), constants()), |(R, (C, D))| {
        near_number("psi of a rotation", course.subject.psi_neo_hookean(&R, C, D)?, 0.0, 1e-13 * (C + D))
    })
}

fn a_uniform_expansion_depends_on_d_alone(course: &Course) -> Outcome {
    for_all(course.seed, (-1.0..1.0, constants()), |(power, (C, D))| {
        let s = f64::exp(power);
        let F = Matrix3::identity() * s;
        let expected = D * (s.powi(3) - 1.0).powi(2);
        near_number(
            "psi(s 1) = D (s³ − 1)²",
            course.subject.psi_neo_hookean(&F, C, D)?,
            expected,
            1e-12 * energy_terms(&F, C, D),
        )
    })
}

fn a_simple_shear_depends_on_c_alone(course: &Course) -> Outcome {
    for_all(course.seed, (-3.0..3.0, constants()), |(gamma, (C, D))| {
        for (i, j) in [(0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)] {
            let mut F = Matrix3::identity();
            F[(i, j)] = gamma;
            let rule = "psi(1 + γ e_i ⊗ e_j) = C γ², the trace is that of FᵀF";
            let allowed = 1e-12 * energy_terms(&F, C, D);
            near_number(rule, course.subject.psi_neo_hookean(&F, C, D)?, C * gamma * gamma, allowed)?;
        }
        Ok(())
    })
}

fn the_table_of_the_page_holds(course: &Course) -> Outcome {
    let F = Matrix3::from_diagonal(&Vector3::new(2.0, 1.0, 0.5));
    let found = course.subject.psi_neo_hookean(&F, 4.0, 7.0)?;
    with_input("F = diag(2, 1, ½), C = 4, D = 7", near_number("the table of the page", found, 9.0, 1e-12))
}

fn the_energy_depends_on_the_principal_stretches_alone(course: &Course) -> Outcome {
    for_all(course.seed, (rotation(), stretches(), rotation(), constants()), |(U, sigma, W, (C, D))| {
        let along_the_axes = Matrix3::from_diagonal(&sigma);
        let F = U * along_the_axes * W.transpose();
        for (C, D, rule) in [(C, 0.0, "the first term alone"), (0.0, D, "the second term alone"), (C, D, "psi")] {
            let expected = course.subject.psi_neo_hookean(&along_the_axes, C, D)?;
            near_number(rule, course.subject.psi_neo_hookean(&F, C, D)?, expected, 2e-12 * energy_terms(&F, C, D))?;
        }
        Ok(())
    })
}

fn known_stretches_agree_with_a_calculation_by_hand(course: &Course) -> Outcome {
    // Stretches whose product is the cube of a number, and what they cost with C = 1, D = 0 and with C = 0, D = 1.
    let known = [
        ([8.0, 1.0, 1.0], 13.5, 49.0),
        ([2.0, 1.0, 4.0], 2.25, 49.0),
        ([1.0, 1.0, 0.125], 5.0625, 0.765625),
        ([3.0, 0.5, 18.0], 34.02777777777778, 676.0),
        ([0.25, 2.0, 0.25], 13.5, 0.765625),
        ([2.0, 3.0, 1.0 / 6.0], 10.027777777777779, 0.0),
    ];
    for_all(course.seed, (0..known.len(), rotation(), rotation(), constants()), |(row, U, W, (C, D))| {
        let (sigma, shape, volume) = known[row];
        let F = U * Matrix3::from_diagonal(&sigma.into()) * W;
        let found = course.subject.psi_neo_hookean(&F, C, D)?;
        let rule = "psi of known stretches";
        near_number(rule, found, C * shape + D * volume, 1e-12 * energy_terms(&F, C, D))
    })
}

fn one_term_depends_on_the_shape_alone_and_the_other_on_the_volume(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), -1.0..1.0, constants()), |(F, power, (C, D))| {
        let blown_up = F * f64::exp(power);
        let (found, expected) =
            (course.subject.psi_neo_hookean(&blown_up, C, 0.0)?, course.subject.psi_neo_hookean(&F, C, 0.0)?);
        let rule = "a uniform expansion does not change the first term";
        near_number(rule, found, expected, 2e-12 * energy_terms(&F, C, 0.0))?;
        let as_even = Matrix3::identity() * F.determinant().cbrt();
        let (found, expected) =
            (course.subject.psi_neo_hookean(&F, 0.0, D)?, course.subject.psi_neo_hookean(&as_even, 0.0, D)?);
        let rule = "the second term is the same for all shapes of one volume";
        near_number(rule, found, expected, 2e-12 * energy_terms(&F, 0.0, D))
    })
}

fn the_energy_is_the_same_in_every_rotated_frame(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), rotation(), constants()), |(F, R, (C, D))| {
        let (expected, allowed) = (course.subject.psi_neo_hookean(&F, C, D)?, 1e-12 * energy_terms(&F, C, D));
        near_number("psi(R F) = psi(F)", course.subject.psi_neo_hookean(&(R * F), C, D)?, expected, allowed)?;
        near_number("psi(F R) = psi(F)", course.subject.psi_neo_hookean(&(F * R), C, D)?, expected, allowed)?;
        near_number("psi(Fᵀ) = psi(F)", course.subject.psi_neo_hookean(&F.transpose(), C, D)?, expected, allowed)
    })
}

fn the_energy_is_never_negative(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), constants()), |(F, (C, D))| {
        let is_positive = course.subject.psi_neo_hookean(&F, C, D)? >= -slack(1e-13) * energy_terms(&F, C, D);
        holds("the energy is never negative", is_positive)
    })
}

fn flat_and_inverted_states_have_infinite_energy(course: &Course) -> Outcome {
    let mirror = |x: f64, y: f64, z: f64| Matrix3::from_diagonal(&Vector3::new(x, y, z));
    let dependent = Matrix3::new(1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 1.0);
    let states = [Matrix3::zeros(), mirror(1.0, 0.0, 1.0), dependent, mirror(-1.0, 1.0, 1.0), -Matrix3::identity()];
    for F in states.into_iter().chain([mirror(1.0, 1.0, -1e-3), mirror(5.0, -3.0, 2.0), mirror(-0.9, 0.8, 0.9)]) {
        near_number("psi where J ≤ 0 (never NaN)", course.subject.psi_neo_hookean(&F, 1e5, 1e6)?, f64::INFINITY, 0.0)?;
        near_number("psi where J ≤ 0, with D = 0", course.subject.psi_neo_hookean(&F, 1e5, 0.0)?, f64::INFINITY, 0.0)?;
    }
    for_all(course.seed, (deformation(), constants()), |(F, (C, D))| {
        near_number("psi of a mirrored state", course.subject.psi_neo_hookean(&-F, C, D)?, f64::INFINITY, 0.0)
    })
}

fn strong_but_possible_states_have_a_finite_energy(course: &Course) -> Outcome {
    for s in [1e-3f64, 0.03, 0.5, 30.0] {
        let (F, expected) = (Matrix3::identity() * s, 7.0 * (s.powi(3) - 1.0).powi(2));
        near_number(
            "psi(s 1) = D (s³ − 1)²",
            course.subject.psi_neo_hookean(&F, 2.0, 7.0)?,
            expected,
            1e-13 * (6.0 + expected),
        )?;
    }
    let flattened = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 1e-6));
    let expected = 2.0 * (2.0 * 1e4 - 3.0) + 7.0 * (1.0 - 1e-6_f64).powi(2);
    let found = course.subject.psi_neo_hookean(&flattened, 2.0, 7.0)?;
    let rule = "a body that is almost flat has a large and finite energy";
    with_input("F = diag(1, 1, 1e-6), C = 2, D = 7", near_number(rule, found, expected, 1e-6))
}

/// The energy of F = 1 + E for a small E, in 32 digits.
pub fn energy_near_rest(E: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let number = DoubleDouble::from;
    let e = |i: usize, j: usize| number(E[(i % 3, j % 3)]);
    let minus = number(-1.0);
    let I_minus_3: DoubleDouble =
        E.iter().map(|&entry| number(entry) * number(entry)).chain((0..3).map(|i| number(2.0) * e(i, i))).sum();
    let minors = (0..3).map(|i| e(i, i) * e(i + 1, i + 1) + minus * e(i, i + 1) * e(i + 1, i));
    let sarrus = (0..3).map(|i| e(0, i) * e(1, i + 1) * e(2, i + 2) + minus * e(0, i + 2) * e(1, i + 1) * e(2, i));
    let x: DoubleDouble = (0..3).map(|i| e(i, i)).chain(minors).chain(sarrus).sum();
    // (1 + x)^(−2/3) − 1 by the binomial series; the next term would be x¹³.
    let (mut term, mut g_minus_1) = (number(1.0), number(0.0));
    for k in 0..12 {
        let k = f64::from(k);
        // (−2/3 − k) / (k + 1) = −(3k + 2) / (3k + 3), whose quotient is refined once to reach 32 digits.
        let (numerator, denominator) = (-(3.0 * k + 2.0), 3.0 * k + 3.0);
        let quotient = numerator / denominator;
        let rest = (-quotient).mul_add(denominator, numerator) / denominator;
        term = term * x * (number(quotient) + number(rest));
        g_minus_1 = g_minus_1 + term;
    }
    let shape = (number(1.0) + g_minus_1) * I_minus_3 + number(3.0) * g_minus_1;
    f64::from(number(C) * shape + number(D) * x * x)
}

fn near_rest_the_error_is_round_off_of_the_terms(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), -8.0..-3.0, constants()), |(direction, power, (C, D))| {
        let F = Matrix3::identity() + direction * 10f64.powf(power);
        let expected = energy_near_rest(&(F - Matrix3::identity()), C, D);
        near_number(
            "psi near rest",
            course.subject.psi_neo_hookean(&F, C, D)?,
            expected,
            2e-15 * energy_terms(&F, C, D),
        )
    })
}
