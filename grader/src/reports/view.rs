//! The contents of the reports: words, figures as people read them, and the part that students may see.

use grader::status::Status;

use super::escape;
pub use crate::grade::points;
use crate::grade::{FunctionGrade, Grade};

/// The error that a double cannot fall below: a plot draws smaller ones here.
pub const ERROR_FLOOR: f64 = 1e-16;

/// The functions, and the whole simulation after them.
pub fn parts(grade: &Grade) -> impl Iterator<Item = &FunctionGrade> {
    grade.functions.iter().chain([&grade.simulation])
}

/// A status as people say it.
pub fn label(status: Status) -> &'static str {
    match status {
        Status::Passed => "passed",
        Status::Failed => "failed",
        Status::Crashed => "crashed",
        Status::TimedOut => "timed out",
        Status::DidNotCompile => "does not compile",
        Status::Refused => "refused",
        Status::Missing => "missing",
    }
}

/// A status as `grade.json` spells it.
pub fn key(status: Status) -> &'static str {
    match status {
        Status::TimedOut => "timed_out",
        Status::DidNotCompile => "did_not_compile",
        other => label(other),
    }
}

/// The name of a check as a sentence.
pub fn sentence(check: &str) -> String {
    escape::line(&grader::properties::sentence(check))
}

/// The texts for a student about a function: the diagnosis, its sentence or the compiler's message, the hint.
pub fn notes(function: &FunctionGrade, show_diagnosis: bool) -> Vec<String> {
    let mut notes = Vec::new();
    match &function.diagnosis {
        // The message explains the diagnosis, so both are hidden together.
        Some(_) if !show_diagnosis => {}
        Some(diagnosis) => {
            notes.push(format!("Looks like: {diagnosis}"));
            notes.extend(function.message.clone());
        }
        None => notes.extend(function.message.clone()),
    }
    if show_diagnosis {
        notes.extend(function.location.clone());
    }
    if function.status != Status::Passed {
        notes.extend(function.hint.as_ref().map(|hint| format!("Hint: {hint}")));
    }
    notes.extend(function.growth.and_then(|growth| growth.sentence()));
    notes.retain(|note| !note.trim().is_empty());
    notes
}

/// Returns true if a function has notes beside its figures.
pub fn has_notes(function: &FunctionGrade) -> bool {
    function.status != Status::Passed || function.growth.is_some_and(|growth| growth.is_faster())
}

/// Number of functions that pass, and number of all functions.
pub fn passed(grade: &Grade) -> (usize, usize) {
    (grade.functions.iter().filter(|f| f.status == Status::Passed).count(), grade.functions.len())
}

/// Points as numbers in files: sums like 78.30000000000001 are rounded.
pub fn rounded(points: f64) -> f64 {
    (points * 1e4).round() / 1e4
}

/// The score as a fraction, 0 to 1.
pub fn fraction(score: f64, max_score: f64) -> f64 {
    if max_score > 0.0 && score.is_finite() { (score / max_score).clamp(0.0, 1.0) } else { 0.0 }
}

/// A relative error, such as `2.1e-9`.
pub fn error(error: Option<f64>) -> String {
    match error.filter(|error| error.is_finite()) {
        Some(0.0) => "0".to_owned(),
        Some(error) => format!("{error:.1e}"),
        None => "–".to_owned(),
    }
}

/// A time with the unit that suits it, such as `3.2 µs`.
pub fn seconds(seconds: Option<f64>) -> String {
    match seconds.filter(|seconds| seconds.is_finite() && *seconds >= 0.0) {
        Some(s) if s < 1e-6 => format!("{:.0} ns", s * 1e9),
        Some(s) if s < 1e-3 => format!("{:.1} µs", s * 1e6),
        Some(s) if s < 1.0 => format!("{:.1} ms", s * 1e3),
        Some(s) if s < 100.0 => format!("{s:.1} s"),
        Some(s) => format!("{s:.0} s"),
        None => "–".to_owned(),
    }
}

/// The submission's time in terms of the reference's, such as `1.3×` or `0.04×`.
pub fn ratio(function: &FunctionGrade) -> String {
    match (function.seconds, function.reference_seconds) {
        (Some(own), Some(reference)) if own.is_finite() && reference > 0.0 => {
            let ratio = own / reference;
            if ratio < 0.1 { format!("{ratio:.2}×") } else { format!("{ratio:.1}×") }
        }
        _ => "–".to_owned(),
    }
}

/// The worst error of the functions that answer.
pub fn worst_error(grade: &Grade) -> Option<f64> {
    grade.functions.iter().filter_map(|f| f.error.filter(|error| error.is_finite())).reduce(f64::max)
}

/// The sum of the times of the functions that are right, and how many are: a wrong answer may take no time at all.
pub fn total_seconds(grade: &Grade) -> (Option<f64>, usize) {
    sum(grade.functions.iter().map(timed))
}

/// The time of a function that is right.
pub fn timed(function: &FunctionGrade) -> Option<f64> {
    function.seconds.filter(|_| function.status == Status::Passed)
}

/// The reference's time for the same functions, and how many were timed.
pub fn reference_seconds(grade: &Grade) -> (Option<f64>, usize) {
    sum(grade.functions.iter().map(|f| f.reference_seconds))
}

fn sum(times: impl Iterator<Item = Option<f64>>) -> (Option<f64>, usize) {
    let known: Vec<f64> = times.flatten().filter(|time| time.is_finite() && *time > 0.0).collect();
    ((!known.is_empty()).then(|| known.iter().sum()), known.len())
}
