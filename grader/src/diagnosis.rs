//! Finds the common mistake that explains wrong answers. It is named only if it explains every trial in which it shows.

mod answers;
mod formulas;
mod inputs;
#[cfg(test)]
mod tests;

use grader::implementation::{Implementation, Local, Trouble};

use crate::reference::trial::{Observed, Trial};
use crate::reference::{REFERENCE, TOLERANCE, compare, trials};
use crate::variants::Variant;

/// The mistake that explains a function's answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Short, such as `negated`.
    pub name: String,
    /// Sentence for the student: it teaches and does not give the answer.
    pub sentence: String,
}

/// Answer of a mistake in a trial, from the right answer; `None` if the mistake cannot be made there.
type Answers<'a> = Box<dyn Fn(&Trial, &Observed) -> Option<Observed> + 'a>;

/// A mistake that may have been made.
struct Candidate<'a> {
    name: String,
    sentence: String,
    answers: Answers<'a>,
}

impl<'a> Candidate<'a> {
    fn new(
        name: impl Into<String>,
        sentence: impl Into<String>,
        answers: impl Fn(&Trial, &Observed) -> Option<Observed> + 'a,
    ) -> Self {
        Self { name: name.into(), sentence: sentence.into(), answers: Box::new(answers) }
    }
}

/// One trial with the expected and the observed answer.
struct Case {
    trial: Trial,
    expected: Observed,
    observed: Observed,
}

/// How far, relative to the numbers at hand, a mistake's answer may be from the one that it explains.
const PRECISION: f64 = 1e-6;

/// The simplest mistake that explains the answers of a function; `None` if they are right or if no known mistake explains them.
pub fn diagnose(function: &str, seed: u64, subject: &dyn Implementation, variants: &[Variant]) -> Option<Diagnosis> {
    let cases = cases(function, seed, subject);
    let right = |case: &Case| compare(&case.trial, &case.observed, &case.expected, TOLERANCE).wrongs.is_empty();
    // A second mistake in a limiting case must not hide the first.
    let (ordinary, edges): (Vec<_>, Vec<_>) = cases.iter().partition(|case| !case.trial.edge);
    let all: Vec<_> = ordinary.iter().chain(&edges).copied().collect();
    let candidates: Vec<_> = answers::candidates(&ordinary)
        .into_iter()
        .chain(inputs::candidates())
        .chain(formulas::candidates(function))
        .chain(variants.iter().filter(|variant| variant.function == function).filter_map(from_variant))
        .collect();
    let explained = |cases: &[&Case]| {
        let wrong = cases.iter().any(|case| !right(case));
        candidates.iter().find(|candidate| wrong && explains(candidate, cases))
    };
    let found = explained(&all).or_else(|| explained(&ordinary))?;
    Some(Diagnosis { name: found.name.clone(), sentence: found.sentence.clone() })
}

/// The trials that are answered. After an answer that never comes, nothing more is asked.
fn cases(function: &str, seed: u64, subject: &dyn Implementation) -> Vec<Case> {
    let mut cases = Vec::new();
    for trial in trials(function, seed) {
        let Ok(expected) = trial.run(&Local(REFERENCE)) else { break };
        match trial.run(subject) {
            Ok(observed) => cases.push(Case { trial, expected, observed }),
            Err(Trouble::Panicked { .. }) => {}
            Err(_) => break,
        }
    }
    cases
}

fn from_variant(variant: &Variant) -> Option<Candidate<'_>> {
    let table = Local(variant.functions);
    Some(Candidate::new(variant.diagnosis?, variant.sentence, move |trial, _| trial.run(&table).ok()))
}

fn explains(candidate: &Candidate, cases: &[&Case]) -> bool {
    let mut telling = 0;
    for case in cases {
        let Some(mistaken) = (candidate.answers)(&case.trial, &case.expected) else { return false };
        let size = mistaken.numbers.iter().filter(|x| x.is_finite()).fold(0.0, |size: f64, x| size.max(x.abs()));
        let shows = distance(&mistaken, &case.expected, |i| case.trial.scale(i)) > PRECISION;
        // Where the mistake shows, its own size counts: it may be far larger or smaller than the right answer.
        let off = match shows {
            true => distance(&case.observed, &mistaken, |i| size + 1e-3 * case.trial.scale(i)),
            false => distance(&case.observed, &mistaken, |i| 2.0 * case.trial.scale(i)),
        };
        let fits = off <= PRECISION;
        if !fits {
            return false;
        }
        telling += usize::from(shows);
    }
    telling >= 3 || telling > 0 && telling == cases.len()
}

/// The largest difference; infinite where shapes differ or one side alone is not a number.
fn distance(a: &Observed, b: &Observed, scale: impl Fn(usize) -> f64) -> f64 {
    if a.shape != b.shape || a.numbers.len() != b.numbers.len() {
        return f64::INFINITY;
    }
    let difference = |(i, (a, b)): (usize, (&f64, &f64))| match a == b || a.is_nan() && b.is_nan() {
        true => 0.0,
        false => ((a - b) / scale(i)).abs(),
    };
    let differences = a.numbers.iter().zip(&b.numbers).enumerate().map(difference);
    differences.fold(0.0, |worst, next| if next.is_nan() { f64::INFINITY } else { worst.max(next) })
}
