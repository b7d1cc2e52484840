//! Runs the checks of a function, and summarises the results.

use std::collections::BTreeSet;
use std::panic::{self, AssertUnwindSafe};

use super::recorded::Recorded;
use super::report::Checked;
use crate::implementation::{Implementation, Trouble};
use crate::properties::outcome::{Mistake, message_of};
use crate::properties::{Check, Course, sentence};
use crate::status::Status;

/// Number of failing checks of one function whose messages are kept.
const MOST_MESSAGES: usize = 3;

/// Result of one check.
#[derive(Clone)]
pub struct CheckResult {
    /// The message for the student.
    pub checked: Checked,
    /// The mistake if it fails.
    pub mistake: Option<Mistake>,
    /// The functions that it asked beside the one that it judges.
    pub asked: BTreeSet<&'static str>,
}

/// Runs the checks of a function.
pub fn run_checks(checks: &[Check], subject: &dyn Implementation, trusted: &Recorded, seed: u64) -> Vec<CheckResult> {
    let one = |check: &Check| {
        subject.begin_check();
        trusted.begin_check();
        // A check may panic on a malformed answer.
        let outcome = panic::catch_unwind(AssertUnwindSafe(|| (check.run)(&Course { subject, trusted, seed })));
        let mistake = outcome.unwrap_or(Err(Mistake::Trouble(Trouble::Malformed))).err();
        let (rule, details) = mistake.as_ref().map(told).unwrap_or_default();
        let checked =
            Checked { name: sentence(check.name), passed: mistake.is_none(), waits_for: Vec::new(), rule, details };
        CheckResult { checked, mistake, asked: trusted.take() }
    };
    checks.iter().map(one).collect()
}

fn status_of(mistake: &Mistake) -> Status {
    match mistake {
        Mistake::Wrong { .. } | Mistake::Waits { .. } | Mistake::Trouble(Trouble::Malformed) => Status::Failed,
        Mistake::Trouble(Trouble::TimedOut(_)) => Status::TimedOut,
        Mistake::Trouble(_) => Status::Crashed,
    }
}

/// The rule and the details of a mistake.
fn told(mistake: &Mistake) -> (String, String) {
    match mistake {
        Mistake::Wrong { rule, figures, counterexample } => {
            let input = if counterexample.is_empty() { String::new() } else { format!("with input {counterexample}") };
            (rule.clone(), [figures.clone(), input].join("\n").trim().to_owned())
        }
        Mistake::Trouble(Trouble::Missing) => {
            ("the function comes to a `todo!`; write what is missing there".to_owned(), String::new())
        }
        // Students may read the messages of their own panics on their own machines.
        Mistake::Trouble(Trouble::Panicked { message, .. }) => (format!("{mistake:?}: {message}"), String::new()),
        other => (format!("{other:?}"), String::new()),
    }
}

/// The status of a function, and messages of its first failing checks.
pub fn summary(name: &str, results: &[CheckResult]) -> (Status, Vec<String>) {
    let (mut status, mut messages) = (Status::Passed, Vec::new());
    for CheckResult { checked, mistake, .. } in results {
        let Some(mistake) = mistake else { continue };
        // The reason for giving up is in the messages already.
        if *mistake == Mistake::Trouble(Trouble::GivenUp) && status != Status::Passed {
            continue;
        }
        let found = status_of(mistake);
        // A wrong answer comes before a panic.
        status = if status == Status::Passed { found } else { status.min(found) };
        let message = match mistake {
            Mistake::Wrong { .. } => message_of(name, mistake),
            _ => checked.rule.clone(),
        };
        if !messages.contains(&message) && messages.len() < MOST_MESSAGES {
            messages.push(message);
        }
    }
    (status, messages)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::implementation::Local;
    use grader_child::UNWRITTEN;

    fn outcome(checks: &[Check]) -> (Status, usize) {
        let (nothing, slow) = (Local(UNWRITTEN), BTreeSet::new());
        let results = run_checks(checks, &nothing, &Recorded::new(&nothing, &slow), 1);
        let (status, messages) = summary("psi_neo_hookean", &results);
        (status, messages.len())
    }

    #[test]
    fn a_function_that_is_late_has_not_crashed_and_one_that_trips_a_check_has_failed() {
        let late = Check { name: "late", run: |_| Err(Mistake::Trouble(Trouble::TimedOut(Duration::from_secs(5)))) };
        let given_up = Check { name: "given up", run: |_| Err(Mistake::Trouble(Trouble::GivenUp)) };
        let trips = Check { name: "trips", run: |_| panic!("a check stumbles") };
        assert_eq!(outcome(&[late, given_up]), (Status::TimedOut, 1));
        assert_eq!(outcome(&[trips]), (Status::Failed, 1));
        let open_branch = Check { name: "open", run: |_| Err(Mistake::Trouble(Trouble::Missing)) };
        assert_eq!(outcome(&[open_branch]), (Status::Crashed, 1));
    }

    #[test]
    fn a_function_that_a_program_lacks_is_missing_and_has_not_panicked() {
        let answer = Local(UNWRITTEN).mass_matrix_linear_tetrahedron(1.0, 1.0);
        assert_eq!(answer.map(drop), Err(Trouble::Missing));
    }
}
