//! Locates an error: the inputs, entries and calls for which a function is right or wrong. The sentences contain no inputs and no
//! expected values.

mod calls;
mod probes;

use grader::implementation::{Implementation, Local};

use super::Case;
use super::entries::{places, sets};
use crate::reference::trial::{Observed, Trial};
use crate::reference::{REFERENCE, TOLERANCE, compare};

/// Trials on which a simpler input is tried.
const PROBED: usize = 4;

/// Most inputs that are named.
const MOST: usize = 3;

/// Sentences about where the answers are right; `None` if there is no pattern. Those about entries are left out if the diagnosis tells
/// them: a second set of entries beside the first reads like a contradiction.
pub fn locate(cases: &[Case], subject: &dyn Implementation, tells_entries: bool) -> Option<String> {
    let (good, bad): (Vec<_>, Vec<_>) = cases.iter().partition(|case| case.is_right);
    let first = bad.first()?;
    let mut all = Vec::new();
    // Of a limiting case its kind says more: simpler inputs are no limiting cases any more, whatever they are.
    let ordinary: Vec<_> = bad.iter().copied().filter(|case| !case.trial.edge).collect();
    all.extend(entries(&ordinary).filter(|_| !tells_entries));
    all.extend(calls::told(&bad, subject));
    let probed: Vec<_> = ordinary.iter().map(|case| &case.trial).take(PROBED).collect();
    let probes = probes::PROBES.iter().filter(|(_, change)| is_right(&probed, *change, subject));
    let names: Vec<_> = probes.map(|(name, _)| *name).take(MOST).collect();
    if !names.is_empty() {
        all.push(format!("It is right {}.", listed(&names)));
    }
    let kinds = |cases: &[&Case]| {
        let mut kinds: Vec<_> = cases.iter().map(|case| case.trial.name).collect();
        kinds.sort_unstable();
        kinds.dedup();
        kinds
    };
    let telling: Vec<_> = good.into_iter().filter(|case| says_something(&case.expected)).collect();
    let (wrong, mut never) = (kinds(&bad), kinds(&telling));
    never.retain(|kind| !wrong.contains(kind));
    if !never.is_empty() {
        never.truncate(MOST);
        all.push(format!(
            "Kinds of input with right answers: {}; with wrong ones, among others: {}.",
            never.join(", "),
            first.trial.name
        ));
    }
    (!all.is_empty()).then(|| all.join(" "))
}

/// Returns true if trials that were wrong are right after this change of their input; false if no trial can be changed.
fn is_right(trials: &[&Trial], change: probes::Change, subject: &dyn Implementation) -> bool {
    let changed: Vec<_> = trials.iter().filter_map(|trial| changed(trial, change)).collect();
    let is_right = |trial: &Trial| {
        let (Ok(expected), Ok(observed)) = (trial.run(&Local(REFERENCE)), trial.run(subject)) else { return false };
        says_something(&expected) && compare(trial, &observed, &expected, TOLERANCE).wrongs.is_empty()
    };
    !changed.is_empty() && changed.iter().all(is_right)
}

/// Returns true if the expected answer is not trivial, so that a right answer is evidence.
fn says_something(expected: &Observed) -> bool {
    let largest = expected.numbers.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    largest > 1e-9
}

fn changed(trial: &Trial, change: probes::Change) -> Option<Trial> {
    let mut trial = trial.clone();
    change(&mut trial.input).then_some(trial)
}

fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [most @ .., last] => format!("{}, and {last}", most.join(", ")),
    }
}

/// The largest set of entries that are all right or that alone are wrong.
fn entries(wrong: &[&Case]) -> Option<String> {
    let first = wrong.first()?;
    let sets = sets(&first.trial.input, first.expected.shape);
    if wrong.iter().any(|case| case.observed.shape != case.expected.shape) {
        return None;
    }
    // How many entries are wrong, and how many there are, by whether they belong to a set.
    let count = |contains: fn(&super::entries::Place) -> bool| {
        let mut counts = [[0usize; 2]; 2];
        for case in wrong {
            for (k, place) in places(case.expected.shape).enumerate() {
                let off = (case.observed.numbers[k] - case.expected.numbers[k]).abs() / case.trial.scale(k);
                let is_right = off <= TOLERANCE || case.observed.numbers[k] == case.expected.numbers[k];
                // A right zero is weak evidence.
                let says_something = !is_right || case.expected.numbers[k] != 0.0;
                let side = &mut counts[usize::from(contains(&place))];
                side[0] += usize::from(!is_right);
                side[1] += usize::from(says_something);
            }
        }
        counts
    };
    let mut found: Vec<(usize, String)> = Vec::new();
    for &(name, contains) in sets {
        let [[wrong_outside, outside], [wrong_inside, inside]] = count(contains);
        if outside == 0 || inside == 0 {
            continue;
        }
        if wrong_inside == 0 && wrong_outside > 0 {
            found.push((inside, format!("Right: {name}; wrong entries are elsewhere.")));
        } else if wrong_outside == 0 && wrong_inside > 0 {
            found.push((outside, format!("Wrong entries are only here: {name}.")));
        }
    }
    found.into_iter().max_by_key(|(size, _)| *size).map(|(_, sentence)| sentence)
}
