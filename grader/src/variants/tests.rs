//! Every variant is wrong, and no two variants of a function are wrong in the same way.

use std::collections::BTreeSet;

use super::{ALL, all};
use crate::reference::REFERENCE;

mod grading;
mod simple_inputs;
use simple_inputs::answers;

/// The relative difference from which on two answers differ; far above round-off.
const DIFFERENCE: f64 = 1e-7;

fn differ(a: &[f64], b: &[f64]) -> bool {
    let largest = a.iter().chain(b).filter(|x| x.is_finite()).fold(0.0, |max: f64, x| max.max(x.abs()));
    let entry_differs = |(x, y): (&f64, &f64)| {
        let alike = x == y || (x.is_nan() && y.is_nan()) || (x - y).abs() <= DIFFERENCE * largest;
        !alike
    };
    a.len() != b.len() || a.iter().zip(b).any(entry_differs)
}

fn any_differs(a: &[Vec<f64>], b: &[Vec<f64>]) -> bool {
    a.len() != b.len() || a.iter().zip(b).any(|(a, b)| differ(a, b))
}

#[test]
fn each_of_the_22_functions_has_at_least_four_variants() {
    let functions: BTreeSet<_> = all().map(|variant| variant.function).collect();
    assert_eq!(functions.len(), 22);
    for variants in ALL {
        assert!(variants.len() >= 4, "{} has only {} variants", variants[0].function, variants.len());
        assert!(variants.iter().all(|variant| variant.function == variants[0].function));
    }
}

#[test]
fn names_are_unique_within_a_function_and_sentences_are_sentences() {
    for variants in ALL {
        let names: BTreeSet<_> = variants.iter().map(|variant| variant.diagnosis).collect();
        assert_eq!(names.len(), variants.len(), "a name of {} occurs twice", variants[0].function);
        for variant in variants {
            assert!(variant.sentence.ends_with(['.', '?']), "{}", variant.sentence);
        }
    }
}

#[test]
fn every_variant_answers_something_else_than_the_reference() {
    let mut found = Vec::new();
    for variant in all() {
        let (right, wrong) = (answers(variant.function, &REFERENCE), answers(variant.function, &variant.functions));
        assert!(!right.is_empty(), "{} has no simple inputs", variant.function);
        if !any_differs(&right, &wrong) {
            found.push((variant.function, variant.diagnosis));
        }
    }
    assert!(found.is_empty(), "not wrong: {found:?}");
}

#[test]
fn no_two_variants_of_a_function_answer_alike() {
    let mut alike = Vec::new();
    for variants in ALL {
        let found: Vec<_> = variants.iter().map(|variant| answers(variant.function, &variant.functions)).collect();
        for (i, one) in variants.iter().enumerate() {
            let others = variants.iter().zip(&found).skip(i + 1);
            let same = others.filter(|(_, answer)| !any_differs(&found[i], answer));
            alike.extend(same.map(|(other, _)| (one.function, one.diagnosis, other.diagnosis)));
        }
    }
    assert!(alike.is_empty(), "cannot be told apart: {alike:?}");
}

#[test]
fn every_variant_leaves_the_other_functions_right() {
    let functions: Vec<_> = ALL.iter().map(|variants| variants[0].function).collect();
    let right: Vec<_> = functions.iter().map(|name| answers(name, &REFERENCE)).collect();
    for variants in ALL {
        for (name, right) in functions.iter().zip(&right).filter(|(name, _)| **name != variants[0].function) {
            assert!(!any_differs(right, &answers(name, &variants[0].functions)), "{name}");
        }
    }
}
