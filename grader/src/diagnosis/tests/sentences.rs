//! Sentences that once misled.

use finite_elements_3d as solved;
use grader::implementation::Local;
use grader_child::Functions;

use super::super::{Explanation, explain};
use crate::reference::REFERENCE;
use crate::variants;

fn explained(function: &str, functions: Functions) -> Explanation {
    explain(function, 5, &Local(functions), variants::of(function))
}

#[test]
fn a_missing_power_of_the_volume_ratio_is_no_integer_division() {
    let functions = Functions {
        psi_neo_hookean: |F, C, D| {
            let J = F.determinant();
            if J <= 0.0 { f64::INFINITY } else { C * (F.norm_squared() - 3.0) + D * (J - 1.0).powi(2) }
        },
        ..REFERENCE
    };
    let diagnosis = explained("psi_neo_hookean", functions).diagnosis.unwrap();
    assert_eq!(diagnosis.name, "power of J without effect");
    assert!(!diagnosis.sentence.to_lowercase().contains("integer"), "{}", diagnosis.sentence);
}

#[test]
fn the_derivative_of_the_stress_has_no_vertices() {
    let functions = Functions {
        d2psi_neo_hookean_dF2: |F, C, D| {
            let mut H = solved::d2psi_neo_hookean_dF2(F, C, D);
            H[(0, 1)] = F[(0, 0)].sin() * C;
            H
        },
        ..REFERENCE
    };
    let location = explained("d2psi_neo_hookean_dF2", functions).location.unwrap();
    assert!(!location.contains("vertex"), "{location}");
}

#[test]
fn an_inversion_that_is_not_seen_is_no_matter_of_symmetry() {
    let functions = Functions {
        psi_neo_hookean: |F, C, D| {
            let J = F.determinant();
            C * (J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2)
        },
        ..REFERENCE
    };
    let location = explained("psi_neo_hookean", functions).location.unwrap();
    assert!(!location.contains("symmetric") && location.contains("inside out"), "{location}");
}

#[test]
fn entries_are_told_once() {
    let functions = Functions {
        mass_matrix_linear_tetrahedron: |density, volume| {
            let mut M = solved::mass_matrix_linear_tetrahedron(density, volume);
            (0..144).filter(|k| k / 12 / 3 != k % 12 / 3).for_each(|k| M[(k / 12, k % 12)] *= 2.0);
            M
        },
        ..REFERENCE
    };
    let Explanation { diagnosis, location } = explained("mass_matrix_linear_tetrahedron", functions);
    let diagnosis = diagnosis.unwrap();
    assert!(!location.clone().unwrap_or_default().contains("ntries"), "{diagnosis:?} {location:?}");
}

#[test]
fn a_number_has_no_entries_and_a_shape_function_no_force() {
    let twice = Functions { psi_neo_hookean: |F, C, D| 2.0 * solved::psi_neo_hookean(F, C, D), ..REFERENCE };
    let sentence = explained("psi_neo_hookean", twice).diagnosis.unwrap().sentence;
    assert!(sentence.starts_with("The answer is 2 times"), "{sentence}");
    let negated = Functions { phi_linear_tetrahedron: |V, e, x| -solved::phi_linear_tetrahedron(V, e, x), ..REFERENCE };
    let sentence = explained("phi_linear_tetrahedron", negated).diagnosis.unwrap().sentence;
    assert!(sentence.starts_with("Every entry has the opposite sign") && !sentence.contains("force"), "{sentence}");
}
