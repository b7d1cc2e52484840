//! Formulas as sums of terms: the coefficient of each is read off the answers by least squares.

use grader_child::algebra;
use nalgebra::{DMatrix, DVector};

use super::answers::{whole, written};
use super::{Candidate, Case};
use crate::reference::trial::{Observed, Trial};

/// The terms of a trial, each as long as the answer.
type Values<'a> = Box<dyn Fn(&Trial) -> Option<Vec<Vec<f64>>> + 'a>;

/// A sum of terms that may have been computed.
pub struct Formula<'a> {
    /// The mistake in it even where all coefficients are right; `None` for the right formula.
    pub name: Option<(&'a str, &'a str)>,
    /// The name of each term, as in `missing NAME`, and its right coefficient.
    pub terms: &'a [(&'a str, f64)],
    /// The terms of a trial one after the other; `None` if it has other input.
    pub values: Values<'a>,
}

/// Largest misfit of a coefficient that still counts as the right one.
const NEAR: f64 = 1e-6;

/// The name of a term that does not belong to the formula.
pub const OTHER: &str = "another term";

/// Number of cases in a first, quick test of a formula.
const FIRST: usize = 4;

/// The mistake that explains the answers by these terms in the entries that are `among` them; `None` if none does or if too many of its coefficients are wrong.
pub fn candidate<'a>(formula: Formula<'a>, cases: &[&Case], among: &[bool]) -> Option<Candidate<'a>> {
    let entries = among.iter().filter(|of| **of).count().max(1);
    let few = &cases[..cases.len().min(FIRST.max(1 + formula.terms.len() / entries))];
    fitted(&formula, few, among)?;
    let coefficients = fitted(&formula, cases, among)?;
    let (name, sentence) = told(&formula, &coefficients, whole(among.len()))?;
    let (values, among) = (formula.values, among.to_vec());
    let name = if among.iter().all(|of| *of) { name } else { format!("in some entries {name}") };
    Some(Candidate::new(name, sentence, move |trial, answer| {
        let terms = values(trial)?;
        let sum = |k: usize| match among[k] {
            true => terms.iter().zip(&coefficients).map(|(term, c)| term[k] * c).sum(),
            false => answer.numbers[k],
        };
        Some(Observed { numbers: (0..answer.numbers.len()).map(sum).collect(), ..answer.clone() })
    }))
}

/// Coefficients that fit the answers; `None` if none do.
fn fitted(formula: &Formula, cases: &[&Case], among: &[bool]) -> Option<Vec<f64>> {
    let n = formula.terms.len();
    let (mut rows, mut right) = (Vec::new(), Vec::new());
    for case in cases {
        let terms = (formula.values)(&case.trial)?;
        for k in (0..case.observed.numbers.len()).filter(|&k| among[k]) {
            let size: f64 = terms.iter().map(|term| term[k].abs()).sum();
            let observed = case.observed.numbers[k];
            // Entries that are not finite are left out of the fit; the comparison of answers tests them.
            if !observed.is_finite() || !size.is_finite() {
                continue;
            }
            let scale = size.max(1e-3 * case.trial.scale(k));
            rows.extend(terms.iter().map(|term| term[k] / scale));
            right.push(observed / scale);
        }
    }
    if right.len() < n {
        return None;
    }
    let (A, b) = (DMatrix::from_row_slice(right.len(), n, &rows), DVector::from_vec(right));
    let x = algebra::least_squares(&A, &b)?;
    // A term that is zero in all of these entries says nothing, so that its coefficient counts as right.
    let of_term = |j: usize| if A.column(j).amax() == 0.0 { formula.terms[j].1 } else { x[j] };
    let coefficients: Vec<f64> = (0..n).map(of_term).collect();
    let misfit = algebra::misfit(&A, &DVector::from_column_slice(&coefficients), &b);
    (misfit <= NEAR && coefficients.iter().all(|c| c.is_finite())).then_some(coefficients)
}

/// Name and sentence of what is wrong.
fn told(formula: &Formula, coefficients: &[f64], whole: &str) -> Option<(String, String)> {
    if let Some(replaced) = replaced(formula, coefficients) {
        return Some(replaced);
    }
    let wrong: Vec<(String, String)> = formula
        .terms
        .iter()
        .zip(coefficients)
        .filter_map(|(&(name, right), &c)| told_of_term(name, c, right))
        .collect();
    let own = formula.name.map(|(name, sentence)| (name.to_owned(), sentence.to_owned()));
    if let Some((name, sentence)) = formula.name
        && let Some(factor) = common_factor(formula, coefficients)
    {
        let factor = written(factor);
        return Some((
            format!("{name} and scaled by {factor}"),
            format!("{sentence} Besides, {} is {factor} times as large as it should be.", whole.to_lowercase()),
        ));
    }
    // If no term is right, the fit is no explanation.
    let explains = wrong.len() <= 2 && (own.is_none() || wrong.len() < 2) && (own.is_some() || !wrong.is_empty());
    let all: Vec<_> = own.into_iter().chain(wrong).collect();
    let (names, sentences): (Vec<_>, Vec<_>) = all.into_iter().unzip();
    explains.then(|| (names.join(" and "), sentences.join(" ")))
}

/// A term that is missing while the last one, which does not belong to the formula, is there.
fn replaced(formula: &Formula, coefficients: &[f64]) -> Option<(String, String)> {
    let near = |a: f64, b: f64| (a - b).abs() <= NEAR * 10.0 * (1.0 + b.abs());
    let other =
        formula.terms.last().zip(coefficients.last()).filter(|((name, _), c)| *name == OTHER && !near(**c, 0.0));
    other?;
    let changed = formula.terms.iter().zip(coefficients).filter(|((_, right), c)| *right != 0.0 && !near(**c, *right));
    let changed: Vec<_> = changed.map(|((name, _), _)| *name).collect();
    // Two terms, where the one is the transpose of the other.
    let [first, ..] = changed[..] else { return None };
    let names = changed.join(" and ");
    (formula.name.is_none() && changed.len() <= 2).then(|| {
        (
            format!("{first} with another factor"),
            format!("Of the terms, look at {names}: its factor depends on F in another way."),
        )
    })
}

/// The factor that all coefficients have, other than 1.
fn common_factor(formula: &Formula, coefficients: &[f64]) -> Option<f64> {
    let mut factors = formula.terms.iter().zip(coefficients).map(|((_, right), c)| c / right);
    let first = factors.next()?;
    let others = factors.all(|factor| (factor - first).abs() <= NEAR * 10.0);
    (others && (first - 1.0).abs() > 1e-3 && first.abs() > 1e-3 && first.is_finite()).then_some(first)
}

fn told_of_term(name: &str, c: f64, right: f64) -> Option<(String, String)> {
    let near = |wanted: f64| (c - wanted).abs() <= NEAR * 10.0 * (1.0 + wanted.abs());
    if near(right) {
        return None;
    }
    Some(if near(0.0) {
        (
            format!("missing {name}"),
            format!("The answer is as if {name} were not there: derive the formula term by term."),
        )
    } else if right == 0.0 {
        (format!("additional {name}"), format!("The answer contains {name}, which the formula does not have."))
    } else if near(-right) {
        (format!("{name} with the wrong sign"), format!("Look at the sign of {name}."))
    } else {
        let factor = written(c / right);
        (
            format!("{name} scaled by {factor}"),
            format!(
                "Of the terms, {name} is {factor} times as large as it should be: which constant is missing in it, or there twice?"
            ),
        )
    })
}
