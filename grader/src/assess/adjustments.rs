//! `adjustments.csv`: points and comments by hand, with the columns `student`, `function`, `points`, `reason` and `comment`.
//!
//! Points replace those of the checks: the points of the function, or, if `function` is empty, the score after the penalty for lateness.
//! They need a reason, which only the instructor sees. A comment is shown to the student, with or without points.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;

use crate::grade::Adjustment;
use crate::rubric::Rubric;

/// The file's name, in the folder of the submissions.
pub const ADJUSTMENTS: &str = "adjustments.csv";

/// The rows of the table.
#[derive(Clone, Debug, Default)]
pub struct Adjustments(Vec<(String, Adjustment)>);

/// Errors in the table.
#[derive(Debug, Error)]
pub enum AdjustmentsError {
    #[error("{path}: {error}; its columns are student, function, points, reason, comment", path = .0.display(), error = .1)]
    Csv(PathBuf, csv::Error),
    #[error("{path}, line {line}: {problem}")]
    Row { path: PathBuf, line: u64, problem: String },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    student: String,
    #[serde(default)]
    function: String,
    #[serde(default)]
    points: String,
    #[serde(default)]
    reason: String,
    #[serde(default)]
    comment: String,
}

impl Adjustments {
    /// Reads the table of a folder of submissions, if there is one.
    ///
    /// # Errors
    /// The first row that cannot be used, with its line.
    pub fn of_class(folder: &Path, rubric: &Rubric) -> Result<Self, AdjustmentsError> {
        let path = folder.join(ADJUSTMENTS);
        if !path.is_file() {
            return Ok(Self::default());
        }
        let unreadable = |error| AdjustmentsError::Csv(path.clone(), error);
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_path(&path).map_err(unreadable)?;
        let heading = reader.headers().map_err(unreadable)?.clone();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(unreadable)?;
            let line = record.position().map_or(0, csv::Position::line);
            let row: Row = record.deserialize(Some(&heading)).map_err(unreadable)?;
            let adjustment = row.checked(rubric);
            let problem = |problem| AdjustmentsError::Row { path: path.clone(), line, problem };
            rows.push((row.student.clone(), adjustment.map_err(problem)?));
        }
        Ok(Self(rows))
    }

    /// Those of a student who is known by any of these names.
    pub fn of(&self, students: &[&str]) -> Vec<Adjustment> {
        let own = self.0.iter().filter(|(student, _)| students.contains(&student.as_str()));
        own.map(|(_, adjustment)| adjustment.clone()).collect()
    }

    /// Names that are not among the students.
    pub fn strangers(&self, students: &[&str]) -> Vec<String> {
        let mut names: Vec<String> = self.0.iter().map(|(student, _)| student.clone()).collect();
        names.retain(|name| !students.contains(&name.as_str()));
        names.sort();
        names.dedup();
        names
    }
}

impl Row {
    fn checked(&self, rubric: &Rubric) -> Result<Adjustment, String> {
        if self.student.is_empty() {
            return Err("has no student; name one".to_owned());
        }
        let most = match self.function.as_str() {
            "" => rubric.max_score(),
            "simulation" => rubric.simulation.points,
            name => match rubric.functions.iter().find(|function| function.name.get_ref() == name) {
                Some(function) => *function.points.get_ref(),
                None => return Err(format!("the rubric asks for no function `{name}`; leave it empty for the whole")),
            },
        };
        let points = match self.points.as_str() {
            "" => None,
            text => Some(text.parse().map_err(|_| format!("points `{text}` is no number"))?),
        };
        if let Some(points) = points.filter(|points| !(0.0..=most).contains(points)) {
            return Err(format!("points = {points}; give a number from 0 to {most}"));
        }
        if points.is_some() && self.reason.is_empty() {
            return Err("points by hand need a reason; write it into the column `reason`".to_owned());
        }
        if points.is_none() && self.comment.is_empty() {
            return Err("has neither points nor a comment; write one, or remove the row".to_owned());
        }
        let text = |text: &String| (!text.is_empty()).then(|| text.clone());
        let (function, reason, comment) = (text(&self.function), text(&self.reason), text(&self.comment));
        Ok(Adjustment { function, points, reason, comment })
    }
}
