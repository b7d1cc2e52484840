//! Mistakes that are told by the kind of trial they show in, and by how much.

use super::{Case, Diagnosis, right};
use crate::reference::TOLERANCE;
use crate::reference::compare::compare;

/// The mistake of a function whose answers hold no number at all.
pub fn not_a_number(cases: &[&Case]) -> Option<Diagnosis> {
    let nothing = |case: &&Case| case.observed.numbers.iter().all(|x| !x.is_finite());
    let wrong: Vec<_> =
        cases.iter().copied().filter(|case| !right(case) && !case.observed.numbers.is_empty()).collect();
    (wrong.len() > 2 && wrong.iter().all(nothing)).then(|| Diagnosis {
        name: "not a number".to_owned(),
        sentence: "The answers are NaN or infinite: which division, root, power or logarithm has no value there?"
            .to_owned(),
    })
}

/// The mistake of a function that is right but for limiting cases.
pub fn limiting_case(cases: &[&Case]) -> Option<Diagnosis> {
    let wrong: Vec<_> = cases.iter().filter(|case| !right(case)).collect();
    if wrong.is_empty() || wrong.iter().any(|case| !case.trial.edge) {
        return None;
    }
    let any = |is: fn(&f64) -> bool| wrong.iter().any(|case| case.observed.numbers.iter().any(is));
    let (how, told) = if any(|x| x.is_nan()) {
        ("NaN", "the answer is not a number")
    } else if any(|x| x.is_infinite()) {
        ("infinite", "the answer is infinite")
    } else if wrong.iter().all(|case| case.observed.shape != case.expected.shape) {
        ("wrong size", "the answer has another size than it should have")
    } else if wrong.iter().any(|case| case.expected.numbers.iter().any(|x| x.is_infinite())) {
        ("finite", "the answer is finite")
    } else {
        ("wrong", "the answer is wrong")
    };
    let mut kinds: Vec<_> = wrong.iter().map(|case| case.trial.name).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let kinds = kinds.join(", ");
    Some(Diagnosis {
        name: format!("{how} in a limiting case"),
        sentence: format!("Right in general; {told} in a limiting case ({kinds}). What does the page say about it?"),
    })
}

/// Most that an answer may be wrong in any trial to count as nearly right.
const NEARLY_RIGHT: f64 = 2e-3;

/// The mistake of a function that is nearly right in every trial.
pub fn inexact(cases: &[&Case]) -> Option<Diagnosis> {
    let errors: Option<Vec<f64>> = cases
        .iter()
        .filter(|case| !case.trial.edge)
        .map(|case| compare(&case.trial, &case.observed, &case.expected, TOLERANCE).error)
        .collect();
    let errors = errors?;
    let worst = errors.iter().fold(0.0, |worst: f64, error| worst.max(*error));
    let wrong = errors.iter().filter(|error| **error > TOLERANCE).count();
    (worst > TOLERANCE && worst <= NEARLY_RIGHT && 2 * wrong > errors.len()).then(|| Diagnosis {
        name: "inexact".to_owned(),
        sentence: format!(
            "Nearly right everywhere, to about {:.0} digits. Finite differences, single precision, a slack or a rounded constant are not exact.",
            -worst.log10().ceil()
        ),
    })
}
