//! `result.json`, as Classroom 50 asks of every autograder: schema `classroom50/result/v1`
//! (<https://github.com/foundation50/classroom50/wiki/Advanced-Autograding>).
//!
//! The schema takes whole points alone, so each point counts as [`UNITS_PER_POINT`]: a submission's share stays exact.

use std::io;
use std::time::SystemTime;

use grader::status::Status;
use jiff::Timestamp;
use serde::Serialize;

use super::{escape, gradescope, view};
use crate::grade::{FunctionGrade, Grade};

/// Hundredths. The same in every submission, so that the figures of a class compare.
pub const UNITS_PER_POINT: f64 = 100.0;

/// Origin of a submission. The runner of Classroom 50 passes it to an autograder in the environment.
#[derive(Clone, Debug)]
pub struct Origin {
    classroom: String,
    assignment: String,
    assignment_type: String,
    owner: String,
    submission: String,
    commit: String,
    release: String,
    review: String,
}

impl Origin {
    /// Reads the environment of this process; `None` outside Classroom 50.
    pub fn from_environment() -> Option<Self> {
        Self::from_variables(|name| std::env::var(name).ok())
    }

    /// The same from any source of variables.
    pub fn from_variables(variable: impl Fn(&str) -> Option<String>) -> Option<Self> {
        let variable = |name: &str| variable(name).filter(|value| !value.trim().is_empty());
        let commit = variable("COMMIT_URL")?;
        Some(Self {
            classroom: variable("CLASSROOM")?,
            assignment: variable("ASSIGNMENT")?,
            assignment_type: variable("ASSIGNMENT_TYPE").unwrap_or_else(|| "individual".to_owned()),
            owner: variable("OWNER").or_else(|| variable("USERNAME"))?,
            submission: variable("SUBMISSION_TAG")?,
            release: variable("RELEASE_URL")?,
            review: variable("REVIEW_URL").unwrap_or_else(|| commit.clone()),
            commit,
        })
    }
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Outcome {
    schema: &'static str,
    classroom: String,
    assignment: String,
    #[serde(rename = "assignment_type")]
    assignment_type: String,
    owner: String,
    submission: String,
    commit: String,
    release: String,
    review: String,
    datetime: String,
    score: u64,
    max_score: u64,
    tests: Vec<Test>,
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Test {
    test_name: String,
    passed: bool,
    score: u64,
    max_score: u64,
    output: String,
}

/// The text of `result.json`.
pub fn render(grade: &Grade, origin: &Origin, show_diagnosis: bool) -> io::Result<String> {
    let tests: Vec<Test> = view::parts(grade).map(|part| test(part, show_diagnosis)).collect();
    let outcome = Outcome {
        schema: "classroom50/result/v1",
        classroom: origin.classroom.clone(),
        assignment: origin.assignment.clone(),
        assignment_type: origin.assignment_type.clone(),
        owner: origin.owner.clone(),
        submission: origin.submission.clone(),
        commit: origin.commit.clone(),
        release: origin.release.clone(),
        review: origin.review.clone(),
        datetime: utc(SystemTime::now()),
        score: units(grade.score, grade.max_score),
        max_score: units(grade.max_score, grade.max_score),
        tests,
    };
    Ok(serde_json::to_string_pretty(&outcome)? + "\n")
}

fn test(part: &FunctionGrade, show_diagnosis: bool) -> Test {
    Test {
        test_name: escape::line(&part.name),
        passed: part.status == Status::Passed,
        score: units(part.score, part.max_score),
        max_score: units(part.max_score, part.max_score),
        output: gradescope::story(part, show_diagnosis),
    }
}

fn units(points: f64, max_points: f64) -> u64 {
    (points.clamp(0.0, max_points.max(0.0)) * UNITS_PER_POINT).round() as u64
}

/// A time as `2026-06-01T14:32:01Z`.
fn utc(time: SystemTime) -> String {
    // A clock beyond the year 9999 is wrong; 1970 is written in its place.
    Timestamp::try_from(time).unwrap_or_default().strftime("%FT%TZ").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, UNIX_EPOCH};

    #[test]
    fn times_are_written_in_utc() {
        let at = |seconds| utc(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00Z");
        assert_eq!(at(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(at(1_780_324_321), "2026-06-01T14:32:01Z");
        assert_eq!(at(4_107_542_399), "2100-02-28T23:59:59Z");
        assert_eq!(at(4_107_542_400), "2100-03-01T00:00:00Z");
    }
}
