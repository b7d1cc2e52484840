//! Submissions in which no function was found, although something was handed in: their author may have packed them in another way.

use grader::status::Status;

use super::{Entry, Outcome};
use crate::grade::{Grade, points};

/// The score, and the reason if no function was found.
pub fn score(grade: &Grade) -> String {
    let why = reason(grade).map_or(String::new(), |why| format!("; {why}"));
    format!("{} of {}{why}", points(grade.score), points(grade.max_score))
}

/// The reason for a grade of a submission in which no function was found, if the submission gives one.
fn reason(grade: &Grade) -> Option<String> {
    let is_empty = grade.functions.iter().all(|function| function.status == Status::Missing);
    (is_empty && !grade.remarks.is_empty()).then(|| format!("no function was found: {}", grade.remarks.join("; ")))
}

/// Remarks on the graded submissions in which no function was found.
pub fn remarks(entries: &[Entry]) -> Vec<String> {
    let mut remarks: Vec<String> = Vec::new();
    for entry in entries {
        if let Outcome::Graded(grade, _) = &entry.outcome
            && let Some(why) = reason(grade)
        {
            remarks.push(format!("{}: {why}", entry.submission));
        }
    }
    // A group's submission is there once for each student.
    remarks.dedup();
    remarks
}
