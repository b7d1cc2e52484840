//! A class as its table and its page show it: one row for each submission that counts, graded or not.

use crate::class::{Entry, Outcome, student_folder};
use crate::grade::Grade;

/// A submission that counts, with the older ones of its student.
pub struct Row<'a> {
    pub entry: &'a Entry,
    /// Names of the submissions in whose place it counts.
    pub older: Vec<&'a str>,
}

/// The rows of a class, by student and then by submission. An older submission is named in the row of its student.
pub fn rows(entries: &[Entry]) -> Vec<Row<'_>> {
    let is_older = |entry: &&Entry| matches!(entry.outcome, Outcome::Older { .. });
    let older = |student: &str| {
        let of_student = entries.iter().filter(is_older).filter(|entry| entry.student == student);
        of_student.map(|entry| entry.submission.as_str()).collect()
    };
    let counting = entries.iter().filter(|entry| !is_older(entry));
    let mut rows: Vec<Row> = counting.map(|entry| Row { entry, older: older(&entry.student) }).collect();
    rows.sort_by_key(|row| (row.entry.student.to_lowercase(), row.entry.submission.clone()));
    rows
}

impl Row<'_> {
    /// The grade; one that is missing is not a grade of zero.
    pub fn grade(&self) -> Option<&Grade> {
        match &self.entry.outcome {
            Outcome::Graded(grade, _) => Some(grade),
            _ => None,
        }
    }

    /// The score and the most that could be had; `None` where there is no grade.
    pub fn score(&self) -> (Option<f64>, Option<f64>) {
        match (&self.entry.outcome, self.grade()) {
            (_, Some(grade)) => (Some(grade.score), Some(grade.max_score)),
            (Outcome::NoSubmission(score), None) => (*score, None),
            _ => (None, None),
        }
    }

    /// Returns true if the student has a submission.
    pub fn has_submission(&self) -> bool {
        !matches!(self.entry.outcome, Outcome::NoSubmission(_))
    }

    /// Path of the submission's page, relative to the class's, parts divided by `/`.
    pub fn page(&self) -> Option<String> {
        match &self.entry.outcome {
            Outcome::Graded(..) => {
                let page = student_folder(&self.entry.student).join("report.html");
                Some(page.to_string_lossy().replace('\\', "/"))
            }
            _ => None,
        }
    }

    /// A note for the instructor: the reason for a missing grade, the grader's remarks, the older submissions that it replaces.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = match &self.entry.outcome {
            Outcome::Graded(grade, _) => grade.remarks.clone(),
            Outcome::NotGraded(reason) => vec![format!("not graded: {reason}")],
            Outcome::Waiting => vec!["not graded yet".to_owned()],
            Outcome::Older { newer } => vec![format!("{newer} counts")],
            Outcome::NoSubmission(_) => vec!["no submission".to_owned()],
        };
        if !self.older.is_empty() {
            notes.push(format!("in place of {}", self.older.join(", ")));
        }
        notes
    }
}
