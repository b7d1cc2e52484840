//! Runs the checks of a function, and summarises the results.

use std::panic::{self, AssertUnwindSafe};

use super::report::Checked;
use crate::implementation::Trouble;
use crate::properties::outcome::{Mistake, message_of};
use crate::properties::{Check, Course, sentence};
use crate::status::Status;

/// Number of failing checks of one function whose messages are kept.
const MOST_MESSAGES: usize = 3;

/// A check, and the mistake and the status if it fails.
pub type CheckResult = (Checked, Option<(Mistake, Status)>);

/// Runs the checks of a function. `missing` are the functions that its text names and that are not written.
pub fn run_checks(checks: &[Check], course: &Course, missing: &[&str]) -> Vec<CheckResult> {
    let one = |check: &Check| {
        course.subject.begin_check();
        course.trusted.begin_check();
        // A check may panic on a malformed answer.
        let outcome = panic::catch_unwind(AssertUnwindSafe(|| (check.run)(course)));
        let mistake = outcome.unwrap_or(Err(Mistake::Trouble(Trouble::Malformed))).err();
        let (rule, details) = mistake.as_ref().map(|mistake| told(mistake, missing)).unwrap_or_default();
        let checked = Checked { name: sentence(check.name), passed: mistake.is_none(), rule, details };
        let status = |mistake: &Mistake| status_of(mistake, missing);
        (checked, mistake.map(|mistake| (mistake.clone(), status(&mistake))))
    };
    checks.iter().map(one).collect()
}

fn status_of(mistake: &Mistake, missing: &[&str]) -> Status {
    match mistake {
        Mistake::Wrong { .. } | Mistake::Trouble(Trouble::Malformed) => Status::Failed,
        Mistake::Trouble(Trouble::TimedOut(_)) => Status::TimedOut,
        // If no other function is missing, the `todo!` is in a branch of this one.
        Mistake::Trouble(Trouble::Missing) if missing.is_empty() => Status::Crashed,
        Mistake::Trouble(Trouble::Missing) | Mistake::Waits { .. } => Status::Missing,
        Mistake::Trouble(_) => Status::Crashed,
    }
}

/// The rule and the details of a mistake.
fn told(mistake: &Mistake, missing: &[&str]) -> (String, String) {
    match mistake {
        Mistake::Wrong { rule, figures, counterexample } => {
            let input = if counterexample.is_empty() { String::new() } else { format!("with input {counterexample}") };
            (rule.clone(), [figures.clone(), input].join("\n").trim().to_owned())
        }
        Mistake::Trouble(Trouble::Missing) if !missing.is_empty() => {
            (format!("waits for {}", missing.join(", ")), String::new())
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
pub fn summary(name: &str, checked: &[CheckResult]) -> (Status, Vec<String>) {
    let (mut status, mut messages) = (Status::Passed, Vec::new());
    for (check, mistake) in checked {
        let Some((mistake, found)) = mistake else { continue };
        // The reason for giving up is in the messages already.
        if *mistake == Mistake::Trouble(Trouble::GivenUp) && status != Status::Passed {
            continue;
        }
        // A wrong answer comes before a check that waits for another function.
        status = if status == Status::Passed { *found } else { status.min(*found) };
        let message = match mistake {
            Mistake::Wrong { .. } => message_of(name, mistake),
            _ => check.rule.clone(),
        };
        if !messages.contains(&message) && messages.len() < MOST_MESSAGES {
            messages.push(message);
        }
    }
    (status, messages)
}
