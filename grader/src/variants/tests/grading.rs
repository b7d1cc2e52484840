//! Tests of grading: a mistake costs marks only in its own function, and most mistakes are named.

use std::panic::{self, AssertUnwindSafe};
use std::thread;

use grader::implementation::Local;
use grader::properties::outcome::Outcome;
use grader::properties::{Course, FUNCTIONS};
use grader_child::{Functions, course_functions};

use super::super::{ALL, Variant, of};
use crate::diagnosis::explain;
use crate::reference::judge::judge;
use crate::reference::{REFERENCE, TOLERANCE};

/// Inputs are the same ones in every run.
const SEEDS: [u64; 3] = [1, 2, 3];

/// Number of variants of each function that are tested, one after the other, beside right functions.
const TURNS: usize = 4;

/// Smallest share of the mistakes with a name that the diagnosis must name.
const NAMED: f64 = 0.8;

/// The check that a function fails, as a grade would list it; `None` if it passes all.
fn first_failure(function: &str, functions: Functions, seed: u64) -> Option<String> {
    let subject = Local(functions);
    let judgement = judge(function, seed, &subject, TOLERANCE).expect("the reference answers");
    if let Some(trouble) = judgement.troubles.values().next() {
        return Some(trouble.to_string());
    }
    if let Some(failure) = judgement.failures.first() {
        return Some(failure.rule.to_owned());
    }
    let course = Course { subject: &subject, trusted: &Local(REFERENCE), seed };
    let (_, checks) = FUNCTIONS.iter().find(|(name, _)| *name == function)?;
    let passes = |run: fn(&Course) -> Outcome| {
        let outcome = panic::catch_unwind(AssertUnwindSafe(|| run(&course)));
        matches!(outcome, Ok(Ok(())))
    };
    checks.iter().find(|check| !passes(check.run)).map(|check| check.name.to_owned())
}

/// Results of `find` for the variants of each function; the functions are shared between two threads.
fn in_parallel<T: Send>(find: impl Fn(&'static [Variant]) -> Vec<T> + Sync) -> Vec<T> {
    let half = |first: usize| ALL.into_iter().skip(first).step_by(2).flat_map(&find).collect::<Vec<_>>();
    thread::scope(|scope| {
        let others = scope.spawn(|| half(1));
        let mut found = half(0);
        found.extend(others.join().expect("no check panics past its judge"));
        found
    })
}

fn label(variant: &Variant) -> String {
    format!("{}: {}", variant.function, variant.diagnosis.unwrap_or(variant.sentence))
}

#[test]
fn every_variant_loses_marks_in_its_own_function() {
    let unnoticed = in_parallel(|variants| {
        let passes =
            |one: &&Variant| SEEDS.iter().any(|&seed| first_failure(one.function, one.functions, seed).is_none());
        variants.iter().filter(passes).map(label).collect()
    });
    assert!(unnoticed.is_empty(), "not noticed: {unnoticed:#?}");
}

macro_rules! copied {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The table with a variant's function in it.
        fn with(table: Functions, variant: &Variant) -> Functions {
            match variant.function {
                $(stringify!($name) => Functions { $name: variant.functions.$name, ..table },)*
                other => panic!("{other} is no function"),
            }
        }
    };
}
course_functions!(copied);

#[test]
fn mistakes_in_all_other_functions_cost_nothing_in_a_right_one() {
    let wrongly = in_parallel(|own| {
        let function = own[0].function;
        let failure_beside = |turn: usize| {
            let others = ALL.into_iter().filter(|variants| variants[0].function != function);
            let table = others.fold(REFERENCE, |table, variants| with(table, &variants[turn % variants.len()]));
            first_failure(function, table, SEEDS[0]).map(|what| format!("{function}: {what}"))
        };
        (0..TURNS).filter_map(failure_beside).collect()
    });
    assert!(wrongly.is_empty(), "{wrongly:#?}");
}

/// Asserts the smallest share of the mistakes with a name that the diagnosis names.
fn assert_most_are_named(seeds: &[u64]) {
    let named = in_parallel(|variants| {
        let with_names = variants.iter().filter_map(|one| Some((one, one.diagnosis?)));
        let told = |(one, wanted, seed): (&'static Variant, &str, u64)| {
            let explanation = explain(one.function, seed, &Local(one.functions), of(one.function));
            let found = explanation.diagnosis.map(|found| found.name);
            (found.as_deref() != Some(wanted)).then(|| format!("{}, seed {seed}, but found {found:?}", label(one)))
        };
        with_names.flat_map(|(one, wanted)| seeds.iter().map(move |&seed| (one, wanted, seed))).map(told).collect()
    });
    let misses: Vec<_> = named.iter().flatten().collect();
    let share = 1.0 - misses.len() as f64 / named.len() as f64;
    assert!(share >= NAMED, "{:.1} % of {} are named; not so: {misses:#?}", 100.0 * share, named.len());
}

#[test]
fn most_mistakes_are_named() {
    assert_most_are_named(&SEEDS[..1]);
}

#[test]
#[ignore = "takes a minute; .ci/long runs it"]
fn most_mistakes_are_named_with_other_seeds() {
    assert_most_are_named(&SEEDS[1..]);
}
