//! Mistakes that are recognised by the kind of trials that they affect, and by the size of the error.

use std::cell::RefCell;

use grader::implementation::Implementation;

use super::{Case, Diagnosis};
use crate::reference::TOLERANCE;
use crate::reference::compare::compare;
use crate::reference::trial::Input;

/// The mistake of a function whose answers hold no number at all.
pub fn not_a_number(cases: &[&Case]) -> Option<Diagnosis> {
    let is_empty = |case: &&Case| case.observed.numbers.is_empty();
    if cases.iter().all(is_empty) && cases.iter().filter(|case| !case.is_right).count() > 2 {
        return Some(Diagnosis::new("empty", "The answer is empty, whatever the input. Is what was found returned?"));
    }
    let nothing = |case: &&Case| case.observed.numbers.iter().all(|x| !x.is_finite());
    let wrong: Vec<_> =
        cases.iter().copied().filter(|case| !case.is_right && !case.observed.numbers.is_empty()).collect();
    let is_nan = |case: &&Case| case.observed.numbers.iter().any(|x| x.is_nan());
    let name = if wrong.iter().any(is_nan) { "not a number" } else { "infinite" };
    let sentence = "The answers are NaN or infinite: which division, root, power or logarithm has no value there?";
    (wrong.len() > 2 && wrong.iter().all(nothing)).then(|| Diagnosis::new(name, sentence))
}

/// The mistake of a function that is right but for limiting cases.
pub fn limiting_case(cases: &[&Case]) -> Option<Diagnosis> {
    let wrong: Vec<_> = cases.iter().filter(|case| !case.is_right).collect();
    if wrong.is_empty() || wrong.iter().any(|case| !case.trial.edge) {
        return None;
    }
    let finite = |case: &&&Case| {
        case.observed.numbers.iter().zip(&case.expected.numbers).any(|(a, b)| a.is_finite() && b.is_infinite())
    };
    let any = |is: fn(&f64) -> bool| wrong.iter().any(|case| case.observed.numbers.iter().any(is));
    let (how, told) = if wrong.iter().any(finite) {
        ("finite", "the answer is finite")
    } else if any(|x| x.is_nan()) {
        ("NaN", "the answer is not a number")
    } else if any(|x| x.is_infinite()) {
        ("infinite", "the answer is infinite")
    } else if wrong.iter().all(|case| case.observed.shape != case.expected.shape) {
        ("wrong size", "the answer has another size than it should have")
    } else {
        ("wrong", "the answer is wrong")
    };
    let mut kinds: Vec<_> = wrong.iter().map(|case| case.trial.name).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let kinds = kinds.join(", ");
    let sentence = format!("Right in general; {told} in a limiting case ({kinds}). What does the page say about it?");
    Some(Diagnosis::new(format!("{how} in a limiting case"), sentence))
}

/// Most that an answer may be wrong in any trial to count as nearly right.
const NEARLY_RIGHT: f64 = 2e-3;

/// The mistake of a function that is nearly right in every trial.
pub fn inexact(cases: &[&Case]) -> Option<Diagnosis> {
    // The scales of iterative methods allow for more than small errors.
    if cases.iter().any(|case| matches!(case.trial.input, Input::Step(_) | Input::Minimum { .. })) {
        return None;
    }
    let errors: Option<Vec<f64>> = cases
        .iter()
        .filter(|case| !case.trial.edge)
        .map(|case| compare(&case.trial, &case.observed, &case.expected, TOLERANCE).error)
        .collect();
    let errors = errors?;
    let worst = errors.iter().fold(0.0, |worst: f64, error| worst.max(*error));
    let wrong = errors.iter().filter(|error| **error > TOLERANCE).count();
    let sentence = format!(
        "Nearly right everywhere, to about {:.0} digits. Finite differences, single precision, a slack or a rounded constant are not exact.",
        -worst.log10().ceil()
    );
    let is_nearly_right = worst > TOLERANCE && worst <= NEARLY_RIGHT && 2 * wrong > errors.len();
    is_nearly_right.then(|| Diagnosis::new("inexact", sentence))
}

/// The mistake of a quadrature that is right but for the point at which it evaluates.
pub fn evaluated_elsewhere(cases: &[Case], subject: &dyn Implementation) -> Option<Diagnosis> {
    let wrong: Vec<_> = cases.iter().filter(|case| !case.is_right).collect();
    let fits = |case: &&Case| {
        let Input::Quadrature { V, element, volume, integrand } = &case.trial.input else { return false };
        let points = RefCell::new(Vec::new());
        let recorded = |X: &_| {
            points.borrow_mut().push(*X);
            integrand.at(X)
        };
        let Ok(answer) = subject.quadrature_single_point(V, element, *volume, &recorded) else { return false };
        let [point] = points.borrow()[..] else { return false };
        let expected = integrand.at(&point) * *volume;
        answer.len() == expected.len() && (&answer - &expected).amax() <= 1e-9 * expected.amax()
    };
    let sentence =
        "The integrand is evaluated once, and its value is used well. At which point does the page want it evaluated?";
    (!wrong.is_empty() && wrong.iter().all(fits)).then(|| Diagnosis::new("evaluated at the wrong point", sentence))
}
