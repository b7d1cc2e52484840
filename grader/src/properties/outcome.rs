//! Outcomes of checks. Comparisons are safe for every answer: a wrong shape or NaN makes a check fail, and never panics.

use std::cell::Cell;
use std::fmt;

use grader_child::algebra;
use nalgebra::{DMatrix, DVector, Dim, Matrix, RawStorage};
use nalgebra_sparse::CsrMatrix;

use crate::implementation::Trouble;

/// Reason why a check fails.
#[derive(Clone, PartialEq)]
pub enum Mistake {
    /// The answer is wrong.
    Wrong {
        /// The broken rule as a sentence. Students may read it, so it contains no input and no expected value.
        rule: String,
        /// The observed and the expected figures; may be empty. Students do not see them in a grade.
        figures: String,
        /// The input, as simple as shrinking made it; may be empty. Students do not see it in a grade.
        counterexample: String,
    },
    /// There is no answer.
    Trouble(Trouble),
    /// A function that the check needs beside the one that it judges gives no answer.
    Waits {
        /// Its name.
        needs: &'static str,
        /// The reason why it does not answer.
        trouble: Trouble,
    },
}

/// Outcome of a check: passed, or the mistake.
pub type Outcome = Result<(), Mistake>;

impl From<Trouble> for Mistake {
    fn from(trouble: Trouble) -> Self {
        Self::Trouble(trouble)
    }
}

// A test that returns an error prints its `Debug` form, so this contains the whole message.
impl fmt::Debug for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wrong { rule, figures, counterexample } => {
                f.write_str(rule)?;
                if !figures.is_empty() {
                    write!(f, ": {figures}")?;
                }
                if !counterexample.is_empty() {
                    write!(f, "\nwith input {counterexample}")?;
                }
                Ok(())
            }
            Self::Trouble(trouble) => write!(f, "{trouble}"),
            Self::Waits { needs, trouble } => write!(f, "this check needs {needs}: {trouble}"),
        }
    }
}

/// The message for the author of a mistake: the broken rule and the page to read.
pub fn message_of(function: &str, mistake: &Mistake) -> String {
    format!("{mistake:?}\nRead include-docs/{function}.md")
}

fn wrong(rule: &str, figures: String) -> Mistake {
    Mistake::Wrong { rule: rule.to_owned(), figures, counterexample: String::new() }
}

/// Turns the trouble of a function of [`Course::trusted`](super::Course::trusted) into a mistake that is not the fault of the
/// judged function.
pub fn waits(needs: &'static str) -> impl Fn(Trouble) -> Mistake {
    move |trouble| Mistake::Waits { needs, trouble }
}

/// Fails with the sentence `rule` if the condition is false.
///
/// # Errors
/// The mistake.
pub fn holds(rule: &str, condition: bool) -> Outcome {
    if condition { Ok(()) } else { Err(wrong(rule, String::new())) }
}

/// The same outcome; a mistake tells this input beside its rule, which must not name it.
///
/// # Errors
/// The mistake.
pub fn with_input(input: &str, outcome: Outcome) -> Outcome {
    outcome.map_err(|mistake| match mistake {
        Mistake::Wrong { rule, figures, .. } => Mistake::Wrong { rule, figures, counterexample: input.to_owned() },
        other => other,
    })
}

/// The error relative to the terms of an answer that the tolerances of the checks are made for: round-off stays below it.
pub const ROUND_OFF: f64 = 1e-9;

thread_local! {
    /// The rubric's tolerance while [`with_tolerance`] runs.
    static TOLERANCE: Cell<f64> = const { Cell::new(ROUND_OFF) };
}

/// Runs a check with a rubric's tolerance: a larger one than [`ROUND_OFF`] makes every comparison laxer, by as much, and lets an answer
/// differ from the expected one by this part of its largest entry. A smaller one is for the comparison with the reference alone, as the
/// checks stand near round-off already.
pub fn with_tolerance<T>(tolerance: f64, run: impl FnOnce() -> T) -> T {
    struct Restore(f64);
    impl Drop for Restore {
        fn drop(&mut self) {
            TOLERANCE.set(self.0);
        }
    }
    let _restore = Restore(TOLERANCE.replace(tolerance.max(ROUND_OFF)));
    run()
}

/// A tolerance of a check, adjusted to the rubric.
pub fn slack(allowed: f64) -> f64 {
    allowed * (TOLERANCE.get() / ROUND_OFF)
}

/// The same for the comparison with an answer of this size.
fn slack_for(allowed: f64, size: f64) -> f64 {
    let lax = TOLERANCE.get();
    let of_size = if lax > ROUND_OFF && size.is_finite() { lax * size } else { 0.0 };
    slack(allowed) + of_size
}

/// Compares two numbers; NaN is never near, equal infinities are.
///
/// # Errors
/// The mistake, with both numbers.
pub fn near_number(rule: &str, actual: f64, expected: f64, allowed: f64) -> Outcome {
    let allowed = slack_for(allowed, expected.abs());
    if is_near(actual, expected, allowed) {
        return Ok(());
    }
    Err(wrong(rule, format!("got {}, expected {} (may differ by {allowed:.1e})", figure(actual), figure(expected))))
}

/// All digits of a number, with an exponent where it is small or large.
fn figure(number: f64) -> String {
    let is_plain = number == 0.0 || (1e-3..1e7).contains(&number.abs());
    if is_plain { number.to_string() } else { format!("{number:e}") }
}

/// Compares two vectors or matrices entry by entry.
///
/// # Errors
/// The mistake, with the shapes or with the first entry that is not near.
pub fn near<R1: Dim, C1: Dim, S1, R2: Dim, C2: Dim, S2>(
    rule: &str,
    actual: &Matrix<f64, R1, C1, S1>,
    expected: &Matrix<f64, R2, C2, S2>,
    allowed: f64,
) -> Outcome
where
    S1: RawStorage<f64, R1, C1>,
    S2: RawStorage<f64, R2, C2>,
{
    has_shape(rule, actual.shape(), expected.shape())?;
    let entries = (0..expected.ncols()).flat_map(|column| (0..expected.nrows()).map(move |row| (row, column)));
    let allowed = slack_for(allowed, entries.map(|entry| expected[entry].abs()).fold(0.0, f64::max));
    for column in 0..actual.ncols() {
        for row in 0..actual.nrows() {
            let (a, e) = (actual[(row, column)], expected[(row, column)]);
            if !is_near(a, e, allowed) {
                let place = if actual.ncols() == 1 { format!("[{row}]") } else { format!("[({row}, {column})]") };
                let (a, e) = (figure(a), figure(e));
                let figures = format!("entry {place} is {a}, expected {e} (may differ by {allowed:.1e})");
                return Err(wrong(rule, figures));
            }
        }
    }
    Ok(())
}

fn is_near(actual: f64, expected: f64, allowed: f64) -> bool {
    // A comparison with NaN is false, and ∞ − ∞ is NaN.
    actual == expected || (actual - expected).abs() <= allowed
}

fn has_shape(rule: &str, actual: (usize, usize), expected: (usize, usize)) -> Outcome {
    if actual == expected { Ok(()) } else { Err(wrong(rule, format!("got shape {actual:?}, expected {expected:?}"))) }
}

/// Returns the answer as a vector of this length.
///
/// # Errors
/// The mistake, where the length is another one.
pub fn long(length: usize, answer: DVector<f64>) -> Result<DVector<f64>, Mistake> {
    has_shape("the answer has the length that the page promises", answer.shape(), (length, 1))?;
    Ok(answer)
}

/// Returns the sparse answer as a dense matrix of this shape.
///
/// # Errors
/// The mistake if the shape is another one. The dense matrix is not allocated then.
pub fn dense_of(shape: (usize, usize), answer: &CsrMatrix<f64>) -> Result<DMatrix<f64>, Mistake> {
    has_shape("the answer has the shape that the page promises", (answer.nrows(), answer.ncols()), shape)?;
    Ok(DMatrix::from(answer))
}

/// Eigenvalues of a symmetric answer.
///
/// # Errors
/// The mistake, where the answer is not finite or none are found.
pub fn eigenvalues_of<R: Dim, S: RawStorage<f64, R, R>>(
    answer: &Matrix<f64, R, R, S>,
) -> Result<DVector<f64>, Mistake> {
    let size = answer.nrows();
    let matrix = DMatrix::from_fn(size, size, |row, column| answer[(row, column)]);
    let scale = matrix.amax();
    holds("every entry is finite", matrix.iter().all(|entry| entry.is_finite()))?;
    if scale == 0.0 {
        return Ok(DVector::zeros(size));
    }
    let eigenvalues = algebra::eigenvalues(matrix / scale, MOST_SWEEPS);
    eigenvalues.map(|values| values * scale).ok_or_else(|| wrong("eigenvalues can be found", String::new()))
}

/// Iterations after which the search for eigenvalues ends; a few for each eigenvalue are usual.
const MOST_SWEEPS: usize = 10_000;

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    #[test]
    fn a_laxer_rubric_makes_every_comparison_laxer_and_a_stricter_one_none_stricter() {
        let (far, near_it) = (|| near_number("", 1.0 + 1e-7, 1.0, 1e-12), || near_number("", 1.0 + 1e-13, 1.0, 1e-12));
        assert!(far().is_err() && near_it().is_ok());
        assert!(with_tolerance(1e-6, far).is_ok());
        assert!(with_tolerance(1e-12, near_it).is_ok());
        let entries = || near("", &dvector![1e-8, 3.0], &dvector![0.0, 3.0], 0.0);
        assert!(with_tolerance(1e-6, entries).is_ok() && entries().is_err());
        assert!(with_tolerance(1e-6, || near_number("", f64::NAN, 1.0, 1.0)).is_err());
    }

    #[test]
    fn figures_have_all_digits_and_an_exponent_only_where_it_helps() {
        let shown = [0.0, -12.5, 1e4, 1e7, 2.5e-4, f64::NAN].map(figure);
        assert_eq!(shown, ["0", "-12.5", "10000", "1e7", "2.5e-4", "NaN"]);
    }

    #[test]
    fn a_check_that_panics_leaves_no_lax_tolerance_behind() {
        let _ = std::panic::catch_unwind(|| with_tolerance(1e-3, || panic!("a check stumbles")));
        assert!(near_number("", 1.001, 1.0, 1e-12).is_err());
    }
}
