//! The report of the checks for a student: a line for each function, and details of the next one to work on.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::status::Status;

/// Result of the checks of one function.
pub struct Report {
    /// The function.
    pub name: &'static str,
    /// Its place in the course, from 1.
    pub place: usize,
    /// The outcome.
    pub status: Status,
    /// Number of its checks.
    pub checks: usize,
    /// Messages for the author.
    pub messages: Vec<String>,
    /// The checks that were made, in order; empty if the function could not be run.
    pub checked: Vec<Checked>,
}

/// Result of one check.
pub struct Checked {
    /// Its name as a sentence.
    pub name: String,
    /// The check passes.
    pub passed: bool,
    /// The broken rule, or why there is no answer; empty if it passes.
    pub rule: String,
    /// Figures and input; may be empty.
    pub details: String,
}

/// Level of detail and format of the report.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// 0: the names of the failing checks, and the rule of the first. 1: all rules, with figures and inputs. 2: what the page says of
    /// common mistakes as well.
    pub hints: u8,
    /// Print in colours.
    pub colour: bool,
    /// The repository, for its pages.
    pub folder: &'a Path,
}

const GREEN: &str = "32";
const RED: &str = "31";
const YELLOW: &str = "33";
const BOLD: &str = "1";

impl Report {
    fn passing(&self) -> usize {
        self.checked.iter().filter(|check| check.passed).count()
    }

    /// `9 of 12 checks`, or the reason why none was made.
    fn outcome(&self) -> (&'static str, String) {
        let count = format!("{} of {} checks", self.passing(), self.checks);
        match self.status {
            Status::Passed => (GREEN, format!("passed, {count}")),
            Status::Failed => (RED, format!("failed, {count} pass")),
            Status::Crashed => (RED, format!("crashed, {count} pass")),
            Status::TimedOut => (RED, format!("took too long, {count} pass")),
            Status::DidNotCompile => (RED, "does not compile".to_owned()),
            Status::Refused => (RED, "refused".to_owned()),
            Status::Missing if self.messages.is_empty() => (YELLOW, "not written yet".to_owned()),
            Status::Missing => (YELLOW, format!("waits, {count} pass")),
        }
    }
}

impl View<'_> {
    fn paint(&self, code: &str, text: &str) -> String {
        if self.colour { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }

    /// The functions in a table, then the checks of one of them, then what to do next. That one is the function `about`, if it does
    /// not pass, or else the first that is written and does not.
    pub fn render(&self, reports: &[Report], about: Option<&str>) -> String {
        let mut text = String::new();
        for report in reports {
            let (code, outcome) = report.outcome();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:2} {:32} {}", report.place, report.name, self.paint(code, &outcome));
        }
        let open = |report: &&Report| report.status != Status::Passed;
        let is_told = |report: &&Report| open(report) && !(report.checked.is_empty() && report.messages.is_empty());
        let named = reports.iter().filter(open).find(|report| about == Some(report.name));
        let told = named.or_else(|| reports.iter().find(is_told));
        if let Some(report) = told {
            text.push('\n');
            text.push_str(&self.story(report));
        }
        let passed = reports.iter().filter(|report| report.status == Status::Passed).count();
        if let [one] = reports {
            if one.status == Status::Passed {
                let _ = writeln!(text, "\n{} is done", self.paint(BOLD, one.name));
            }
            return text;
        }
        let _ = writeln!(text, "\n{passed} of {} functions pass", reports.len());
        match reports.iter().find(open) {
            Some(next) => {
                let _ = writeln!(
                    text,
                    "next: {}, with the page include-docs/{}.md",
                    self.paint(BOLD, &format!("src/{}.rs", next.name)),
                    next.name
                );
            }
            None => text.push_str("all of them; run the simulation: cargo run --release -- bunny\n"),
        }
        text
    }

    /// The failing checks of a function.
    fn story(&self, report: &Report) -> String {
        let mut text = format!("{}: {}\n", self.paint(BOLD, report.name), report.outcome().1);
        if report.checked.is_empty() {
            report.messages.iter().for_each(|message| text.push_str(&indented(message, 2)));
            return text;
        }
        for (index, check) in report.checked.iter().filter(|check| !check.passed).enumerate() {
            let _ = writeln!(text, "  {} {}", self.paint(RED, "✗"), check.name);
            if index == 0 || self.hints > 0 {
                text.push_str(&indented(&check.rule, 6));
            }
            if self.hints > 0 {
                text.push_str(&indented(&check.details, 6));
            }
        }
        let page = format!("include-docs/{}.md", report.name);
        match self.hints {
            0 => {
                let _ = writeln!(text, "  read {page}; `--hint` tells the rules, figures and inputs");
            }
            1 => {
                let _ = writeln!(text, "  read {page}; `--hint --hint` tells common mistakes as well");
            }
            _ => text.push_str(&indented(&common_mistakes(&self.folder.join(&page)), 2)),
        }
        text
    }
}

fn indented(text: &str, by: usize) -> String {
    text.lines().map(|line| format!("{:by$}{line}\n", "")).collect()
}

/// The part of a page with this heading.
fn common_mistakes(page: &Path) -> String {
    let Ok(text) = fs::read_to_string(page) else { return format!("{} is not there", page.display()) };
    let part = text.split("\n## ").find_map(|part| part.strip_prefix("Common mistakes"));
    format!("Common mistakes, from {}:\n{}", page.display(), part.unwrap_or_default().trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(name: &'static str, status: Status, outcomes: &[bool]) -> Report {
        let check = |(index, passed): (usize, &bool)| Checked {
            name: format!("check {index}"),
            passed: *passed,
            rule: format!("rule {index}"),
            details: format!("figures {index}\nwith input {index}"),
        };
        let checked = outcomes.iter().enumerate().map(check).collect();
        Report { name, place: 1, status, checks: outcomes.len(), messages: Vec::new(), checked }
    }

    fn text(hints: u8) -> String {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let reports = [
            report("phi_linear_tetrahedron", Status::Passed, &[true, true]),
            report("dphi_linear_tetrahedron_dX", Status::Missing, &[]),
            report("psi_neo_hookean", Status::Failed, &[false, true, false]),
        ];
        View { hints, colour: false, folder: &folder }.render(&reports, None)
    }

    #[test]
    fn failing_checks_are_named_and_counted_and_the_next_function_is_named() {
        let text = text(0);
        assert!(text.contains("psi_neo_hookean                  failed, 1 of 3 checks pass"), "{text}");
        assert!(text.contains("✗ check 0") && text.contains("✗ check 2") && !text.contains("check 1"), "{text}");
        assert!(text.contains("1 of 3 functions pass\nnext: src/dphi_linear_tetrahedron_dX.rs"), "{text}");
    }

    #[test]
    fn hints_come_in_steps() {
        let [first, second, third] = [0, 1, 2].map(text);
        assert!(first.contains("rule 0") && !first.contains("rule 2") && !first.contains("figures 0"), "{first}");
        assert!(second.contains("rule 2") && second.contains("with input 2"), "{second}");
        assert!(!second.contains("Integer division") && third.contains("Integer division"), "{third}");
    }
}
