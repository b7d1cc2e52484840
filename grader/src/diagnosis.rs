//! Finds the common mistake that explains wrong answers. It is named only if it explains every trial in which it shows.

mod algorithms;
mod answers;
mod arguments;
mod differences;
mod entries;
mod fit;
mod formulas;
mod inputs;
mod kinds;
mod location;
mod switches;
mod terms;
#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::collections::HashMap;
use std::ptr;
use std::rc::Rc;

use grader::implementation::{Implementation, Local, Trouble};

use crate::reference::trial::{Input, Observed, Trial};
use crate::reference::{REFERENCE, TOLERANCE, compare, trials};
use crate::variants::Variant;

/// The mistake that explains a function's answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Short, such as `negated`.
    pub name: String,
    /// Sentence for the student: it teaches and does not give the answer.
    pub sentence: String,
    /// The sentence tells which entries are right or wrong, so that no other one has to.
    tells_entries: bool,
}

impl Diagnosis {
    fn new(name: impl Into<String>, sentence: impl Into<String>) -> Self {
        Self { name: name.into(), sentence: sentence.into(), tells_entries: false }
    }
}

/// Answer of a mistake in a trial, from the right answer; `None` if the mistake cannot be made there.
type Answers<'a> = Box<dyn Fn(&Trial, &Observed) -> Option<Observed> + 'a>;

/// A mistake that may have been made.
struct Candidate<'a> {
    name: String,
    sentence: String,
    answers: Answers<'a>,
    /// Its answers so far, by the place of the case: the same case is in several selections of cases.
    known: RefCell<HashMap<*const Case, Option<Rc<Observed>>>>,
    tells_entries: bool,
}

impl<'a> Candidate<'a> {
    fn new(
        name: impl Into<String>,
        sentence: impl Into<String>,
        answers: impl Fn(&Trial, &Observed) -> Option<Observed> + 'a,
    ) -> Self {
        let (name, sentence) = (name.into(), sentence.into());
        Self { name, sentence, answers: Box::new(answers), known: RefCell::default(), tells_entries: false }
    }

    /// Its answer in a case, which is computed once.
    fn answer(&self, case: &Case) -> Option<Rc<Observed>> {
        let known = self.known.borrow().get(&ptr::from_ref(case)).cloned();
        known.unwrap_or_else(|| {
            let answer = (self.answers)(&case.trial, &case.expected).map(Rc::new);
            self.known.borrow_mut().insert(case, answer.clone());
            answer
        })
    }

    /// The same with a sentence that tells which entries are right or wrong.
    fn of_entries(self) -> Self {
        Self { tells_entries: true, ..self }
    }
}

/// One trial with the expected and the observed answer.
struct Case {
    trial: Trial,
    expected: Observed,
    observed: Observed,
    /// The answer breaks no rule.
    is_right: bool,
}

/// Largest relative distance between a mistake's answer and the answer that it explains.
const PRECISION: f64 = 1e-6;

/// Smallest number of answers in which a mistake shows if it is to be named, unless there are fewer answers.
const TELLING: usize = 3;

/// The explanation of a function that fails.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Explanation {
    /// The simplest mistake that explains the answers; `None` if they are right or if no known mistake explains them.
    pub diagnosis: Option<Diagnosis>,
    /// The entries and inputs with right and with wrong answers, in sentences; `None` if there is no pattern.
    pub location: Option<String>,
}

/// Explains the answers of a function.
pub fn explain(function: &str, seed: u64, subject: &dyn Implementation, variants: &[Variant]) -> Explanation {
    let cases = cases(function, seed, subject);
    let found = diagnose(function, &cases, variants);
    let diagnosis = found
        .or_else(|| kinds::evaluated_elsewhere(&cases, subject))
        .or_else(|| arguments::old_velocity(&cases, subject));
    let tells_entries = diagnosis.as_ref().is_some_and(|diagnosis| diagnosis.tells_entries);
    Explanation { location: location::locate(&cases, subject, tells_entries), diagnosis }
}

fn diagnose(function: &str, cases: &[Case], variants: &[Variant]) -> Option<Diagnosis> {
    // Answers that differ from the right ones by no digit are no mistake's.
    let differ = cases.iter().filter(|case| case.observed.numbers != case.expected.numbers).count();
    if differ < TELLING && cases.iter().all(|case| case.is_right) {
        return None;
    }
    let mut cases: Vec<&Case> = cases.iter().collect();
    // Wrong answers come first, because they rule out most candidates.
    cases.sort_by_cached_key(|case| case.is_right);
    // A second mistake in a limiting case must not hide the first.
    let (ordinary, edges): (Vec<&Case>, Vec<_>) = cases.iter().partition(|case| !case.trial.edge);
    let all: Vec<_> = ordinary.iter().chain(&edges).copied().collect();
    let candidates: Vec<_> = answers::candidates(&ordinary)
        .into_iter()
        .chain(inputs::candidates())
        .chain(formulas::candidates(function))
        .chain(variants.iter().filter(|variant| variant.function == function).filter_map(from_variant))
        .chain(entries::candidates(&ordinary))
        .chain(terms::candidates(function, &ordinary))
        .chain(algorithms::candidates(function))
        .chain(entries::exchanged(&ordinary))
        .chain(differences::candidates(function))
        .collect();
    let explained = |cases: &[&Case]| {
        let wrong = cases.iter().any(|case| !case.is_right);
        // Of several explanations, the first that also makes the same number of calls of the closures.
        let mut all = candidates.iter().filter(|candidate| wrong && explains(candidate, cases));
        let first = all.next()?;
        let counts = cases.iter().any(|case| !case.observed.calls.is_empty());
        let same = |candidate: &&Candidate| cases.iter().take(TURNED).all(|case| solves_as_often(candidate, case));
        if !counts || same(&first) { Some(first) } else { all.find(same).or(Some(first)) }
    };
    let diagnosis = |of: &Candidate| Diagnosis {
        name: of.name.clone(),
        sentence: of.sentence.clone(),
        tells_entries: of.tells_entries,
    };
    // If no answer is right, answers that are not finite have too many explanations.
    let nothing = kinds::not_a_number(&ordinary);
    if let Some(nothing) = nothing.clone().filter(|_| !cases.iter().any(|case| case.is_right)) {
        return Some(nothing);
    }
    // At a vertex or on an edge a display vertex may follow any of several elements, and the choice changes wrong weights.
    let inside: Vec<_> =
        ordinary.iter().copied().filter(|case| !["at vertices", "on edges"].contains(&case.trial.name)).collect();
    let inside = || (function == "build_skinning_matrix").then(|| explained(&inside)).flatten();
    if let Some(found) = explained(&all).or_else(|| explained(&ordinary)).or_else(inside) {
        return Some(diagnosis(found));
    }
    if nothing.is_some() {
        return nothing;
    }
    if cases.iter().all(|case| case.is_right) {
        return candidates.iter().find(|candidate| explains_finely(candidate, &all)).map(diagnosis);
    }
    let scaled = || candidates.iter().find_map(|candidate| with_factor(candidate, &ordinary));
    kinds::limiting_case(&all).or_else(scaled).or_else(|| kinds::inexact(&all))
}

/// A candidate's answers times a constant, if that explains the observed answers.
fn with_factor(candidate: &Candidate, cases: &[&Case]) -> Option<Diagnosis> {
    let first = cases.first().filter(|case| has_size(&case.trial.input))?;
    let mistaken = candidate.answer(first)?;
    let size = |x: &f64| if x.is_finite() { x.abs() } else { 0.0 };
    let pairs = mistaken.numbers.iter().zip(&first.observed.numbers);
    let (largest, observed) = pairs.max_by(|a, b| size(a.0).total_cmp(&size(b.0)))?;
    let factor = observed / largest;
    if !factor.is_finite() || factor == 0.0 || (factor - 1.0).abs() < 1e-6 {
        return None;
    }
    let scaled = Candidate::new("", "", |trial, expected| {
        let answer = (candidate.answers)(trial, expected)?;
        Some(Observed { numbers: answer.numbers.iter().map(|x| x * factor).collect(), ..answer })
    });
    let by = answers::written(factor);
    // An implausible factor is no explanation.
    (!by.contains('.') || by.len() < 6).then_some(())?;
    let whole = answers::whole(first.expected.numbers.len()).to_lowercase();
    let (name, sentence) = match by == "-1" {
        true => ("negated".to_owned(), format!("Besides, {whole} has the opposite sign.")),
        false => (format!("scaled by {by}"), format!("Besides, {whole} is {by} times as large as it should be.")),
    };
    explains(&scaled, cases).then(|| Diagnosis {
        name: format!("{} and {name}", candidate.name),
        sentence: format!("{} {sentence}", switches::beside_another(&candidate.sentence)).trim().to_owned(),
        tells_entries: true,
    })
}

/// Returns true if the answers are quantities, which may be wrong by a factor.
fn has_size(input: &Input) -> bool {
    !matches!(
        input,
        Input::Pick(_) | Input::Fixed { .. } | Input::Skinning { .. } | Input::Step(_) | Input::Minimum { .. }
    )
}

/// The trials that are answered. They end at the first call without an answer.
fn cases(function: &str, seed: u64, subject: &dyn Implementation) -> Vec<Case> {
    let mut cases = Vec::new();
    let trials = trials(function, seed);
    // The first trials are special ones.
    let more: Vec<_> = trials.iter().rev().filter_map(turned).take(TURNED).collect();
    for trial in trials.into_iter().chain(more) {
        let Ok(expected) = trial.run(&Local(REFERENCE)) else { break };
        match trial.run(subject) {
            Ok(observed) => {
                let is_right = compare(&trial, &observed, &expected, TOLERANCE).wrongs.is_empty();
                cases.push(Case { trial, expected, observed, is_right });
            }
            Err(Trouble::Panicked { .. }) => {}
            Err(_) => break,
        }
    }
    cases
}

/// Trials that are repeated with elements of the opposite orientation.
const TURNED: usize = 5;

/// The trial with two of each element's vertices exchanged; `None` if it has no elements.
fn turned(trial: &Trial) -> Option<Trial> {
    let mut trial = trial.clone();
    match &mut trial.input {
        Input::Shape { element, .. } | Input::Kinetic { element, .. } | Input::Quadrature { element, .. } => {
            element.swap(1, 2);
        }
        Input::Elastic(elastic) => elastic.element.swap(1, 2),
        _ => return None,
    }
    Some(Trial { name: "of the opposite orientation", ..trial })
}

/// Returns true if a mistake solves as many systems of equations as the submission did.
fn solves_as_often(candidate: &Candidate, case: &Case) -> bool {
    let solves = |answer: &Observed| answer.calls.iter().find(|(name, _)| *name == "solve").map(|(_, n)| *n);
    let mistaken = candidate.answer(case);
    mistaken.is_some_and(|answer| solves(&answer).is_none_or(|n| solves(&case.observed) == Some(n)))
}

fn from_variant(variant: &Variant) -> Option<Candidate<'_>> {
    let table = Local(variant.functions);
    Some(Candidate::new(variant.diagnosis?, variant.sentence, move |trial, _| trial.run(&table).ok()))
}

fn explains(candidate: &Candidate, cases: &[&Case]) -> bool {
    let mut telling = 0;
    for case in cases {
        let Some(mistaken) = candidate.answer(case) else { return false };
        let size = size(&mistaken);
        // The scales of iterative methods allow for round-off that a line search amplifies. This would hide mistakes.
        let iterates = matches!(case.trial.input, Input::Step(_) | Input::Minimum { .. });
        let scale = |i| if iterates { size.max(f64::MIN_POSITIVE) } else { case.trial.scale(i) };
        let shows = distance(&mistaken, &case.expected, scale) > PRECISION;
        // If the mistake changes the answer, differences are relative to its own size, which may differ much from that of the right answer.
        let off = match shows {
            true if iterates => distance(&case.observed, &mistaken, scale),
            true => distance(&case.observed, &mistaken, |i| size + 1e-3 * scale(i)),
            false => distance(&case.observed, &mistaken, |i| 2.0 * scale(i)),
        };
        let fits = off <= PRECISION;
        if !fits {
            return false;
        }
        telling += usize::from(shows);
    }
    telling >= TELLING || telling > 0 && telling == cases.len()
}

fn size(answer: &Observed) -> f64 {
    answer.numbers.iter().filter(|x| x.is_finite()).fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// Returns true if a mistake explains answers that are right within tolerance, by their smallest digits.
fn explains_finely(candidate: &Candidate, cases: &[&Case]) -> bool {
    let mut telling = 0;
    for case in cases {
        let Some(mistaken) = (candidate.answers)(&case.trial, &case.expected) else { return false };
        let difference = distance(&mistaken, &case.expected, |_| 1.0);
        let round_off = 1e-14 * size(&mistaken);
        let fits = distance(&case.observed, &mistaken, |_| 1.0) <= 1e-3 * difference + round_off;
        if !fits {
            return false;
        }
        telling += usize::from(difference.is_finite() && difference > 100.0 * round_off);
    }
    telling >= TELLING
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
