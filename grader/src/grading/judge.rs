//! Judges one function: comparison with the reference, properties, time, and the explanation of a failure.

use std::panic::{self, AssertUnwindSafe};

use grader::implementation::sandboxed::Sandboxed;
use grader::implementation::{Local, Trouble};
use grader::properties::outcome::{Mistake, with_tolerance};
use grader::properties::{Course, FUNCTIONS};
use grader::status::Status;
use grader_child::Exercise;

use super::load::load;
use super::{Grading, GradingError, finished};
use crate::assess::points;
use crate::diagnosis::{Explanation, explain};
use crate::grade::{CheckGrade, FunctionGrade};
use crate::own_checks;
use crate::reference::REFERENCE;
use crate::reference::compare::Check;
use crate::reference::judge::{Reason, judge};
use crate::rubric::Function;
use crate::variants;
use crate::weights::is_edge_case;

/// Smallest number of series of calls, of which the fastest counts.
const LEAST_TURNS: usize = 3;

/// Largest number of series.
const MOST_TURNS: usize = 10;

/// Time of the series between these limits, without disturbances, s.
const ENOUGH: f64 = 0.03;

impl Grading {
    /// Judges a function that compiled.
    pub(super) fn judge(&self, function: &Function, subject: &Sandboxed) -> Result<FunctionGrade, GradingError> {
        let name = function.name.get_ref().as_str();
        subject.next_function();
        let mut grade = finished(function, Status::Passed, None);
        let tolerance = function.tolerance.unwrap_or(self.rubric.tolerance);
        self.compare(&mut grade, name, subject, tolerance);
        let trusted = Local(REFERENCE);
        let course = Course { subject, trusted: &trusted, seed: self.seed };
        let properties = FUNCTIONS.iter().find(|(found, _)| *found == name).map_or(&[][..], |(_, checks)| checks);
        // Edge cases come last: a function that does not end there is not called again after some time-outs.
        let checks: Vec<_> = properties.iter().chain(own_checks::of(name, &self.rubric)).collect();
        let (edges, ordinary): (Vec<_>, Vec<_>) =
            checks.into_iter().enumerate().partition(|(_, check)| is_edge_case(name, check.name));
        let judged = ordinary.into_iter().chain(edges).map(|(place, check)| {
            subject.next_check();
            // A check may panic on a malformed answer.
            let outcome = panic::catch_unwind(AssertUnwindSafe(|| with_tolerance(tolerance, || (check.run)(&course))));
            let stumbled = || Err(Mistake::Trouble(Trouble::Malformed));
            (place, check_grade(check.name, outcome.unwrap_or_else(|_| stumbled())))
        });
        let mut judged: Vec<_> = judged.collect();
        judged.sort_by_key(|(place, _)| *place);
        grade.checks.extend(judged.into_iter().map(|(_, check)| check));
        grade.status = grade.checks.iter().map(|check| check.status).max().unwrap_or(Status::Failed);
        if grade.status == Status::Passed {
            grade.score = grade.max_score;
            grade.hint = None;
        } else {
            subject.next_check();
            self.explain(&mut grade, name, subject);
        }
        subject.next_check();
        self.time(&mut grade, name, subject)?;
        if grade.status == Status::Passed {
            subject.next_check();
            grade.growth = self.growth(name, subject);
            grade.score *= grade.kept(self.rubric.growth_costs);
        }
        Ok(grade)
    }

    fn compare(&self, grade: &mut FunctionGrade, name: &str, subject: &Sandboxed, tolerance: f64) {
        let judged = panic::catch_unwind(AssertUnwindSafe(|| judge(name, self.seed, subject, tolerance)));
        let Ok(Ok(judgement)) = judged else {
            grade.checks.push(check_grade(Check::Agrees.name(), Err(Mistake::Trouble(Trouble::Malformed))));
            return;
        };
        grade.error = judgement.worst_error.filter(|error| error.is_finite());
        for (check, reason) in judgement.checks(name) {
            let outcome = match reason {
                None => Ok(()),
                Some(Reason::Trouble(trouble)) => Err(Mistake::Trouble(trouble.clone())),
                Some(Reason::Wrong(failure)) => Err(Mistake::Wrong {
                    rule: failure.rule.to_owned(),
                    figures: failure.figures.clone(),
                    counterexample: format!("{} (trial {}, {})", failure.input, failure.trial.0, failure.trial.1),
                }),
            };
            grade.checks.push(check_grade(check.name(), outcome));
        }
    }

    /// Partial credit, also where some checks end in a panic or a time-out, and the mistake that explains the answers.
    fn explain(&self, grade: &mut FunctionGrade, name: &str, subject: &Sandboxed) {
        grade.score = points(name, &self.rubric.worth(name, grade.max_score), (grade.status, &grade.checks));
        if grade.status == Status::Failed {
            let asked = AssertUnwindSafe(|| explain(name, self.seed, subject, variants::of(name)));
            let Explanation { diagnosis, location } = panic::catch_unwind(asked).unwrap_or_default();
            grade.location = location;
            if let Some(diagnosis) = diagnosis {
                grade.diagnosis = Some(diagnosis.name);
                grade.message = Some(diagnosis.sentence);
            }
        }
        if grade.message.is_none() {
            let first = grade.checks.iter().find(|check| check.status == grade.status);
            grade.message = first.map(|check| check.message.clone());
        }
    }

    fn time(&self, grade: &mut FunctionGrade, name: &str, subject: &Sandboxed) -> Result<(), GradingError> {
        let Some((function, body, times)) = load(name) else { return Ok(()) };
        let own = || subject.seconds(function, &body, times).ok();
        let reference = || self.reference_seconds(function, &body, times);
        let mut best = (own(), reference()?);
        // Alternately, so that other load on the machine delays both alike.
        for turn in 1..MOST_TURNS {
            let spent = turn as f64 * best.1.max(best.0.unwrap_or(0.0));
            if turn >= LEAST_TURNS && spent > ENOUGH {
                break;
            }
            best = (best.0.and_then(|best| Some(own()?.min(best))), reference()?.min(best.1));
        }
        grade.seconds = best.0.map(|seconds| seconds / times as f64);
        grade.reference_seconds = Some(best.1 / times as f64);
        Ok(())
    }

    pub(super) fn reference_seconds(&self, function: Exercise, body: &[u8], times: u64) -> Result<f64, GradingError> {
        let seconds = self.reference.seconds(function, body, times).or_else(|_| {
            // One process serves all functions, and it may have come to the end of its time while a submission took its own.
            self.reference.next_function();
            self.reference.seconds(function, body, times)
        });
        seconds.map_err(|trouble| GradingError::Reference(trouble.to_string()))
    }
}

/// The result of a check: the message for students apart from the instructor's counterexample.
fn check_grade(name: &str, outcome: Result<(), Mistake>) -> CheckGrade {
    let (status, message, counterexample) = match outcome {
        Ok(()) => (Status::Passed, String::new(), None),
        Err(Mistake::Wrong { rule, figures, counterexample }) => {
            let details: Vec<_> = [figures, counterexample].into_iter().filter(|text| !text.is_empty()).collect();
            (Status::Failed, rule, (!details.is_empty()).then(|| details.join("\nwith input ")))
        }
        Err(Mistake::Trouble(trouble)) => {
            let told = match &trouble {
                Trouble::Panicked { message, .. } => Some(message.clone()),
                _ => None,
            };
            (status_of(&trouble), told_of(&trouble), told)
        }
        Err(Mistake::Waits { needs, trouble }) => (Status::Failed, format!("{needs}: {trouble}"), None),
    };
    CheckGrade { name: name.to_owned(), status, message, counterexample }
}

/// The sentence for students. A file that holds nothing but the handout's `todo!` is never run, so one that is met here stands in
/// a branch.
fn told_of(trouble: &Trouble) -> String {
    match trouble {
        Trouble::Missing => "the function comes to a `todo!`; write what is missing there".to_owned(),
        other => other.to_string(),
    }
}

fn status_of(trouble: &Trouble) -> Status {
    match trouble {
        Trouble::Missing | Trouble::Panicked { .. } | Trouble::Crashed(_) => Status::Crashed,
        // A function that is not called for a check has let too many others wait.
        Trouble::TimedOut(_) | Trouble::GivenUp => Status::TimedOut,
        Trouble::Malformed => Status::Failed,
    }
}
