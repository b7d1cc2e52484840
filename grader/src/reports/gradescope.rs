//! `results.json`, as Gradescope's autograder specification asks for it
//! (<https://gradescope-autograders.readthedocs.io/en/latest/specs/>).
//!
//! All texts are marked `text`: Gradescope shows them verbatim and interprets no markup.

use std::io;

use grader::status::Status;
use serde::Serialize;

use super::{escape, view};
use crate::grade::{FunctionGrade, Grade};

#[derive(Serialize)]
struct Results {
    score: f64,
    /// Left out if it is not finite: Gradescope does not accept null.
    #[serde(skip_serializing_if = "Option::is_none")]
    execution_time: Option<f64>,
    output: String,
    output_format: &'static str,
    visibility: &'static str,
    stdout_visibility: &'static str,
    tests: Vec<Test>,
    leaderboard: Vec<Standing>,
}

#[derive(Serialize)]
struct Test {
    score: f64,
    max_score: f64,
    status: &'static str,
    name: String,
    name_format: &'static str,
    number: String,
    output: String,
    output_format: &'static str,
    visibility: &'static str,
}

#[derive(Serialize)]
struct Standing {
    name: &'static str,
    value: f64,
    order: &'static str,
}

/// The text of `results.json`.
pub fn render(grade: &Grade, show_diagnosis: bool) -> io::Result<String> {
    let results = Results {
        score: view::rounded(grade.score.clamp(0.0, grade.max_score.max(0.0))),
        execution_time: grade.seconds.is_finite().then(|| view::rounded(grade.seconds)),
        output: overview(grade),
        output_format: "text",
        visibility: "visible",
        stdout_visibility: "hidden",
        tests: view::parts(grade).enumerate().map(|(i, part)| test(i, part, show_diagnosis)).collect(),
        leaderboard: standings(grade),
    };
    Ok(serde_json::to_string_pretty(&results)? + "\n")
}

fn test(index: usize, part: &FunctionGrade, show_diagnosis: bool) -> Test {
    Test {
        score: view::rounded(part.score.clamp(0.0, part.max_score.max(0.0))),
        max_score: view::rounded(part.max_score),
        status: if part.status == Status::Passed { "passed" } else { "failed" },
        name: escape::line(&part.name),
        name_format: "text",
        number: (index + 1).to_string(),
        output: story(part, show_diagnosis),
        output_format: "text",
        visibility: "visible",
    }
}

fn overview(grade: &Grade) -> String {
    let (passed, all) = view::passed(grade);
    let mut lines = vec![format!("{passed} of {all} functions pass.")];
    lines.extend(grade.remarks.iter().map(|remark| escape::plain(remark)));
    lines.join("\n")
}

/// A function in plain words: its status, what the student should know, and its checks.
pub(super) fn story(part: &FunctionGrade, show_diagnosis: bool) -> String {
    let mut lines = vec![format!("Status: {}", view::label(part.status))];
    lines.extend(view::notes(part, show_diagnosis).iter().map(|note| escape::plain(note)));
    for check in &part.checks {
        let name = view::sentence(&check.name);
        lines.push(match check.status {
            Status::Passed => format!("[passed] {name}"),
            status => format!("[{}] {name}: {}", view::label(status), escape::line(&check.message)),
        });
    }
    lines.join("\n")
}

/// Smaller is better in both columns. A column without a figure is left out: Gradescope does not accept null.
fn standings(grade: &Grade) -> Vec<Standing> {
    let error = view::worst_error(grade).map(|value| Standing { name: "Error", value, order: "asc" });
    // Sums over fewer functions are smaller and cannot be compared.
    let (seconds, right) = view::total_seconds(grade);
    let time = seconds.filter(|_| right == grade.functions.len()).map(|value| Standing {
        name: "Run time (s)",
        value,
        order: "asc",
    });
    error.into_iter().chain(time).collect()
}
