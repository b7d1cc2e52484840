//! `report.md`: the student's report as Markdown.

use grader::status::Status;

use super::{escape, view};
use crate::grade::{FunctionGrade, Grade};

/// The text of `report.md`.
pub fn render(grade: &Grade, show_diagnosis: bool) -> String {
    let (passed, all) = view::passed(grade);
    let (score, max_score) = (view::points(grade.score), view::points(grade.max_score));
    let mut text = format!("# {}\n\n", escape::markdown(&grade.submission));
    text.push_str(&format!("**{score} of {max_score} points**, {passed} of {all} functions pass.\n\n"));
    for remark in &grade.remarks {
        text.push_str(&item(remark));
    }
    if !grade.remarks.is_empty() {
        text.push('\n');
    }
    text.push_str("| function | status | points | error | time | reference's |\n|---|---|--:|--:|--:|--:|\n");
    for part in view::parts(grade) {
        text.push_str(&row(part));
    }
    for part in view::parts(grade).filter(|part| view::has_notes(part)) {
        text.push_str(&section(part, show_diagnosis));
    }
    text
}

fn row(part: &FunctionGrade) -> String {
    format!(
        "| {} | {} | {} / {} | {} | {} | {} |\n",
        name(&part.name),
        view::label(part.status),
        view::points(part.score),
        view::points(part.max_score),
        view::error(part.error),
        view::seconds(part.seconds),
        view::seconds(part.reference_seconds),
    )
}

fn section(part: &FunctionGrade, show_diagnosis: bool) -> String {
    let mut text = format!("\n## {}: {}\n\n", name(&part.name), view::label(part.status));
    for note in view::notes(part, show_diagnosis) {
        text.push_str(&paragraph(&note));
    }
    for check in &part.checks {
        text.push_str(&match check.status {
            Status::Passed => format!("- [x] {}\n", escape::markdown(&view::sentence(&check.name))),
            status => format!(
                "- [ ] {} ({}): {}\n",
                escape::markdown(&view::sentence(&check.name)),
                view::label(status),
                escape::markdown(&check.message)
            ),
        });
    }
    text
}

fn item(text: &str) -> String {
    format!("- {}\n", escape::markdown(text))
}

/// One line as a sentence; several lines verbatim, because a compiler's message needs its columns.
fn paragraph(text: &str) -> String {
    if text.trim().contains('\n') { escape::fenced(text) + "\n" } else { escape::markdown(text) + "\n\n" }
}

/// The name of a function as code; anything that could end the code is escaped instead.
fn name(name: &str) -> String {
    let is_word = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if is_word { format!("`{name}`") } else { escape::markdown(name) }
}
