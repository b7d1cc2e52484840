//! Results of the checks as a student reads them.

use super::roles::Role;
use crate::status::Status;

/// Result of the checks of one function.
pub struct Report {
    /// The function.
    pub name: &'static str,
    /// Its place in the course, from 1.
    pub place: usize,
    /// Its part in the assignment.
    pub role: Role,
    /// The outcome; `Missing` if it waits.
    pub status: Status,
    /// Number of its checks.
    pub checks: usize,
    /// Messages for the author.
    pub messages: Vec<String>,
    /// The checks that were made, in order; empty if the function could not be run.
    pub checked: Vec<Checked>,
    /// The functions that must pass before anything can be said of this one.
    pub waits_for: Vec<Cause>,
}

/// Result of one check.
#[derive(Clone)]
pub struct Checked {
    /// Its name as a sentence.
    pub name: String,
    /// The check passes.
    pub passed: bool,
    /// Functions that may be to blame in place of the one that is judged, if the check fails.
    pub waits_for: Vec<Cause>,
    /// The broken rule, or why there is no answer; empty if it passes.
    pub rule: String,
    /// Figures and input; may be empty.
    pub details: String,
}

/// A function for which another one waits.
#[derive(Clone)]
pub struct Cause {
    /// Its name.
    pub name: &'static str,
    /// Its outcome.
    pub status: Status,
    /// Its part in the assignment.
    pub role: Role,
}

/// The names of some functions: `a`, `a and b`, `a, b and c`.
pub fn names_of(causes: &[Cause]) -> String {
    listed(&causes.iter().map(|cause| cause.name).collect::<Vec<_>>())
}

fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

impl Report {
    /// It passes all its checks.
    pub fn passes(&self) -> bool {
        self.status == Status::Passed
    }
}
