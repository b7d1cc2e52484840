//! Counts the wrong functions that are named, those that are named right, and those that are located.

use std::thread;

use grader::implementation::Local;

use super::{Mistake, blind, final_validation, repositories, training, validation};
use crate::diagnosis::{Explanation, explain};
use crate::variants;

/// Inputs are the same ones in every run.
const SEED: u64 = 11;

/// A wrong function and its diagnosis.
struct Told {
    mistake: &'static Mistake,
    name: Option<String>,
    sentence: String,
    location: Option<String>,
}

impl Told {
    fn is_named_right(&self) -> bool {
        self.name.as_deref().is_some_and(|name| self.mistake.names.contains(&name))
    }

    /// The pairs of words of the diagnosis and of the location that contradict each other.
    fn contradictions(&self) -> Vec<String> {
        let location = self.location.as_deref().unwrap_or_default();
        let found =
            CONTRADICTIONS.iter().filter(|(one, other)| self.sentence.contains(one) && location.contains(other));
        found.map(|_| format!("{}: {} | {location}", self.mistake.function, self.sentence)).collect()
    }
}

/// Words of a diagnosis, and words of a location that cannot be true beside them.
const CONTRADICTIONS: [(&str, &str); 14] = [
    ("very entry", "Right: "),
    ("very entry", "Wrong entries are only here"),
    ("very entry", "It is right"),
    ("ll other entries", "Right: "),
    ("ll other entries", "Wrong entries are only here"),
    ("no other is wrong", "Right: "),
    ("is zero; what stands there is right", "Right: "),
    ("velocity is right", "right-hand side is not"),
    ("velocity is right", "matrix is not"),
    ("velocity is right", "Right: the positions"),
    ("first direction is right", "right-hand side is not"),
    ("first direction is right", "matrix is not"),
    ("system of equations is right", "is not"),
    ("Inside all is well", "with wrong ones, among others: inside"),
];

/// The explanations of all mistakes; they are shared between two threads.
fn told(mistakes: &[&'static [Mistake]]) -> Vec<Told> {
    let told = |mistake: &'static Mistake| {
        let subject = Local(mistake.functions);
        let Explanation { diagnosis, location } =
            explain(mistake.function, SEED, &subject, variants::of(mistake.function));
        let (name, sentence) = diagnosis.map(|diagnosis| (diagnosis.name, diagnosis.sentence)).unzip();
        Told { mistake, name, sentence: sentence.unwrap_or_default(), location }
    };
    let half = |first: usize| {
        let mistakes = mistakes.iter().copied().flatten().skip(first).step_by(2);
        mistakes.map(told).collect::<Vec<_>>()
    };
    thread::scope(|scope| {
        let others = scope.spawn(|| half(1));
        let mut all = half(0);
        all.extend(others.join().expect("a diagnosis does not panic"));
        all
    })
}

/// Asserts the smallest shares of the mistakes that are named right, and that are named right or located.
fn assert_shares(mistakes: &[&'static [Mistake]], named: f64, named_or_located: f64) {
    let all = told(mistakes);
    let share = |counts: fn(&Told) -> bool| all.iter().filter(|told| counts(told)).count() as f64 / all.len() as f64;
    let (right, either) = (
        share(Told::is_named_right),
        share(|told| told.is_named_right() || told.location.is_some() && told.name.is_none()),
    );
    let others: Vec<_> = all
        .iter()
        .filter(|told| !told.is_named_right())
        .map(|told| format!("{}: {:?} for {:?}", told.mistake.function, told.name, told.mistake.names))
        .collect();
    let contradictions: Vec<_> = all.iter().flat_map(Told::contradictions).collect();
    assert!(
        contradictions.is_empty(),
        "{} of {} contradict themselves: {contradictions:#?}",
        contradictions.len(),
        all.len()
    );
    for Told { mistake, name, sentence, location } in &all {
        println!("{}: {name:?}: {sentence} | {}", mistake.function, location.as_deref().unwrap_or_default());
    }
    println!("of {}: {right:.3} named, {either:.3} named or located; the others: {others:#?}", all.len());
    assert!(
        right >= named && either >= named_or_located,
        "{right:.3} named, {either:.3} named or located: {others:#?}"
    );
}

#[test]
fn mistakes_of_the_training_set_are_named() {
    assert_shares(&training::ALL, 0.97, 0.98);
}

#[test]
fn mistakes_of_the_validation_set_are_named() {
    assert_shares(&validation::ALL, 0.9, 0.94);
}

#[test]
fn mistakes_of_the_final_validation_set_are_named() {
    assert_shares(&final_validation::ALL, 0.9, 0.94);
}

#[test]
fn mistakes_of_the_blind_set_are_named() {
    assert_shares(&blind::ALL, 0.93, 0.93);
}

#[test]
fn mistakes_of_the_repository_set_are_named() {
    assert_shares(&repositories::ALL, 0.9, 0.9);
}
