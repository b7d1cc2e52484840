//! Known mistakes are named. Right answers, and answers that no mistake explains, get no name.

mod mistakes;
mod reported;
mod sentences;

use std::collections::BTreeSet;

use finite_elements_3d as solved;
use grader::implementation::Local;
use grader_child::Functions;
use nalgebra::Matrix3;

use super::explain;
use crate::reference::REFERENCE;
use crate::variants::Variant;
use mistakes::{ELEMENTS, ENERGIES, MESHES, STEPS};

fn named(function: &str, functions: Functions) -> Option<String> {
    named_from(7, function, functions)
}

fn named_from(seed: u64, function: &str, functions: Functions) -> Option<String> {
    explain(function, seed, &Local(functions), &[]).diagnosis.map(|diagnosis| diagnosis.name)
}

#[test]
fn known_mistakes_are_named_whatever_the_seed() {
    let mut wrong = Vec::new();
    for &(function, functions, name) in [ELEMENTS, ENERGIES, MESHES, STEPS].into_iter().flatten() {
        for seed in 0..5 {
            let found = named_from(seed, function, functions);
            if found.as_deref() != Some(name) {
                wrong.push(format!("{function}, seed {seed}: {found:?} instead of {name}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn right_answers_have_no_diagnosis() {
    let functions = [ELEMENTS, ENERGIES, MESHES, STEPS].into_iter().flatten().map(|&(function, ..)| function);
    for function in functions.collect::<BTreeSet<_>>() {
        assert_eq!(named(function, REFERENCE), None, "{function}");
    }
}

#[test]
fn a_mistake_of_its_own_kind_has_no_diagnosis() {
    let odd = Functions { psi_neo_hookean: |F, C, D| C * F.trace().sin() + D, ..REFERENCE };
    assert_eq!(named("psi_neo_hookean", odd), None);
}

#[test]
fn a_mistake_is_named_though_limiting_cases_are_wrong_in_another_way() {
    let functions = Functions { psi_neo_hookean: |F, C, D| -solved::psi_neo_hookean(F, C, D).min(1e200), ..REFERENCE };
    assert_eq!(named("psi_neo_hookean", functions).as_deref(), Some("negated"));
}

#[test]
fn a_variant_is_recognised() {
    fn without_three(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
        solved::psi_neo_hookean(F, C, D) + 3.0 * C
    }
    let functions = Functions { psi_neo_hookean: without_three, ..REFERENCE };
    let variants = [Variant { function: "psi_neo_hookean", diagnosis: Some("missing 3"), sentence: "", functions }];
    let found = explain("psi_neo_hookean", 1, &Local(functions), &variants).diagnosis;
    assert_eq!(found.map(|diagnosis| diagnosis.name).as_deref(), Some("missing 3"));
}
