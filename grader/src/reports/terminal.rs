//! The table that a terminal shows.

use std::io::{self, IsTerminal, Write};

use grader::status::Status;

use super::{escape, view};
use crate::grade::{FunctionGrade, Grade};

const GREEN: &str = "32";
const RED: &str = "31";
const YELLOW: &str = "33";
const BOLD: &str = "1";

/// Prints the report on standard output: coloured on a terminal, unless `NO_COLOR` is set.
pub fn print(grade: &Grade, show_diagnosis: bool) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let colour = stdout.is_terminal() && !refused;
    stdout.write_all(render(grade, show_diagnosis, colour).as_bytes())?;
    stdout.flush()
}

/// The report as text: a table, below it what the student should know of each function that does not pass.
pub fn render(grade: &Grade, show_diagnosis: bool, colour: bool) -> String {
    let paint = |code: &str, text: &str| if colour { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() };
    let width = view::parts(grade).map(|part| escape::line(&part.name).chars().count()).max().unwrap_or(0).max(8);
    let heading = format!("{:<width$}  {:<16}  {:>9}  {:>7}  {:>9}", "function", "status", "points", "error", "time");
    let mut text = paint(BOLD, heading.trim_end()) + "\n";
    for part in view::parts(grade) {
        let status = paint(shade(part.status), &format!("{:<16}", view::label(part.status)));
        text.push_str(&format!("{:<width$}  {status}  {}\n", escape::line(&part.name), figures(part)));
    }
    for part in view::parts(grade).filter(|part| view::has_notes(part)) {
        let story = story(part, show_diagnosis);
        if !story.is_empty() {
            text.push_str(&format!("\n{}\n{story}", paint(BOLD, &escape::line(&part.name))));
        }
    }
    text.push('\n');
    for remark in &grade.remarks {
        text.push_str(&format!("{}\n", escape::line(remark)));
    }
    let (passed, all) = view::passed(grade);
    let score = format!("{} of {} points", view::points(grade.score), view::points(grade.max_score));
    text + &format!("{}, {passed} of {all} functions pass\n", paint(BOLD, &score))
}

fn figures(part: &FunctionGrade) -> String {
    let points = format!("{}/{}", view::points(part.score), view::points(part.max_score));
    format!("{points:>9}  {:>7}  {:>9}", view::error(part.error), view::seconds(part.seconds))
}

fn story(part: &FunctionGrade, show_diagnosis: bool) -> String {
    let mut story = String::new();
    for note in view::notes(part, show_diagnosis) {
        for line in escape::plain(&note).trim_end().lines() {
            story.push_str(&format!("  {line}\n"));
        }
    }
    for check in part.checks.iter().filter(|check| check.status != Status::Passed) {
        let name = view::sentence(&check.name);
        story.push_str(&format!("  {}: {name}: {}\n", view::label(check.status), escape::line(&check.message)));
    }
    story
}

fn shade(status: Status) -> &'static str {
    match status {
        Status::Passed => GREEN,
        Status::Missing => YELLOW,
        _ => RED,
    }
}
