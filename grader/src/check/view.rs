//! Prints the report of the checks: a line for each function, and details of the next one to work on.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use super::next::{Next, next};
use super::report::{Cause, Report, names_of};
use super::roles::Role;
use crate::properties::FUNCTIONS;
use crate::status::Status;

/// The same in the space of a line: at most two names.
fn first_of(causes: &[Cause]) -> String {
    match causes {
        [first, _, more @ ..] if !more.is_empty() => format!("{} and {} more", first.name, more.len() + 1),
        few => names_of(few),
    }
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
    /// The reports are those of one function that was asked for.
    pub only_one: bool,
}

const GREEN: &str = "32";
const RED: &str = "31";
const YELLOW: &str = "33";
const BOLD: &str = "1";

/// Colour and text of an outcome: `9 of 12 checks`, or the reason why none was made.
fn outcome(report: &Report) -> (&'static str, String) {
    let passing = report.checked.iter().filter(|check| check.passed).count();
    let count = format!("{passing} of {} checks", report.checks);
    let (colour, outcome) = match report.status {
        Status::Passed if report.role == Role::Given => (GREEN, "given solved".to_owned()),
        Status::Passed => (GREEN, format!("passed, {count}")),
        Status::Failed => (RED, format!("failed, {count} pass")),
        Status::Crashed => (RED, format!("crashed, {count} pass")),
        Status::TimedOut => (RED, format!("took too long, {count} pass")),
        Status::DidNotCompile => (RED, "does not compile".to_owned()),
        Status::Refused => (RED, "holds something that is not allowed".to_owned()),
        Status::Missing if report.waits_for.is_empty() => (YELLOW, "not written yet".to_owned()),
        Status::Missing => (YELLOW, format!("waits for {}", first_of(&report.waits_for))),
    };
    let later = if report.role == Role::Later { " (a later assignment)" } else { "" };
    (colour, format!("{outcome}{later}"))
}

impl View<'_> {
    fn paint(&self, code: &str, text: &str) -> String {
        if self.colour { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }

    /// The functions in a table, then the failing checks of the next one to work on, then its name. It is the function `about` or what
    /// that one waits for, if it does not pass.
    pub fn render(&self, reports: &[Report], about: Option<&str>) -> String {
        let mut text = String::new();
        for report in reports {
            let (code, outcome) = outcome(report);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:2} {:32} {}", report.place, report.name, self.paint(code, &outcome));
        }
        let next = next(reports, about);
        if let Some(report) =
            next.as_ref().and_then(|next| next.report).filter(|report| report.status != Status::Missing)
        {
            text.push('\n');
            text.push_str(&self.story(report));
        }
        text.push('\n');
        if self.only_one {
            let done = reports.iter().filter(|report| report.passes());
            done.for_each(|report| text.push_str(&format!("{} is done\n", self.paint(BOLD, report.name))));
        } else {
            text.push_str(&count(reports));
        }
        match next {
            // The page is named above.
            Some(next) if self.only_one && next.report.is_some_and(|report| !report.checked.is_empty()) => {}
            Some(next) => text.push_str(&self.told(&next)),
            None if self.only_one => {}
            None => text.push_str(&self.end(reports)),
        }
        text
    }

    /// The next function, its page, and why it is next.
    fn told(&self, next: &Next) -> String {
        let name = next.name;
        let file = self.paint(BOLD, &format!("src/{name}.rs"));
        let mut text = format!("next: {file}, with the page include-docs/{name}.md\n");
        let waiting = match &next.waiting[..] {
            [] => String::new(),
            [one] => format!("{one} waits for it"),
            [one, two] => format!("{one} and {two} wait for it"),
            [one, more @ ..] => format!("{one} and {} more wait for it", more.len()),
        };
        match next.role {
            Role::Asked if waiting.is_empty() => {}
            Role::Asked => text.push_str(&format!("      {waiting}\n")),
            Role::Given => text.push_str(&format!(
                "      it was given solved and has been changed; `cargo run -p grader -- reset {name}` puts it back\n"
            )),
            Role::Later => text.push_str(&format!(
                "      a later assignment asks for it, but {waiting}: write it now, or do without it\n"
            )),
        }
        text
    }

    /// The next command when all functions pass.
    fn end(&self, reports: &[Report]) -> String {
        let is_whole = reports.len() == FUNCTIONS.len() && reports.iter().all(Report::passes);
        if is_whole {
            return "all of them; run the simulation: cargo run -- bunny\n".to_owned();
        }
        "all of this assignment: hand in the folder src\nlater assignments ask for the others; the simulation runs when all are written\n".to_owned()
    }

    /// The failing checks of a function.
    fn story(&self, report: &Report) -> String {
        let mut text = format!("{}: {}\n", self.paint(BOLD, report.name), outcome(report).1);
        let page = format!("include-docs/{}.md", report.name);
        if report.checked.is_empty() {
            report.messages.iter().for_each(|message| text.push_str(&indented(message, 2)));
            return text;
        }
        let (own, waiting): (Vec<_>, Vec<_>) =
            report.checked.iter().filter(|check| !check.passed).partition(|check| check.waits_for.is_empty());
        for (index, check) in own.iter().enumerate() {
            let _ = writeln!(text, "  {} {}", self.paint(RED, "✗"), check.name);
            if index == 0 || self.hints > 0 {
                text.push_str(&indented(&check.rule, 6));
            }
            if self.hints > 0 {
                text.push_str(&indented(&check.details, 6));
            }
        }
        for check in waiting {
            let _ = writeln!(
                text,
                "  {} {}: waits for {}",
                self.paint(YELLOW, "…"),
                check.name,
                names_of(&check.waits_for)
            );
        }
        match self.hints {
            0 => {
                let _ = writeln!(text, "  read {page}; `--hint` shows figures and inputs");
            }
            1 => {
                let _ = writeln!(text, "  read {page}; `--hint --hint` shows common mistakes as well");
            }
            _ => text.push_str(&indented(&common_mistakes(&self.folder.join(&page)), 2)),
        }
        text
    }
}

/// How many of the functions that the assignment asks for pass, and how many wait.
fn count(reports: &[Report]) -> String {
    let asked: Vec<_> = reports.iter().filter(|report| report.role == Role::Asked).collect();
    let passed = asked.iter().filter(|report| report.passes()).count();
    let waiting = asked.iter().filter(|report| !report.waits_for.is_empty()).count();
    let waits = match waiting {
        0 => String::new(),
        1 => ", 1 waits".to_owned(),
        more => format!(", {more} wait"),
    };
    format!("{passed} of {} functions pass{waits}\n", asked.len())
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
    use crate::check::report::Checked;

    fn report(name: &'static str, status: Status, outcomes: &[bool]) -> Report {
        let check = |(index, passed): (usize, &bool)| Checked {
            name: format!("check {index}"),
            passed: *passed,
            waits_for: Vec::new(),
            rule: format!("rule {index}"),
            details: format!("figures {index}\nwith input {index}"),
        };
        let checked = outcomes.iter().enumerate().map(check).collect();
        let (checks, messages, waits_for) = (outcomes.len(), Vec::new(), Vec::new());
        Report { name, place: 1, role: Role::Asked, status, checks, messages, checked, waits_for }
    }

    fn text(hints: u8) -> String {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let reports = [
            report("phi_linear_tetrahedron", Status::Passed, &[true, true]),
            report("dphi_linear_tetrahedron_dX", Status::Missing, &[]),
            report("psi_neo_hookean", Status::Failed, &[false, true, false]),
        ];
        View { hints, colour: false, folder: &folder, only_one: false }.render(&reports, None)
    }

    #[test]
    fn failing_checks_are_named_and_counted_and_a_mistake_is_mended_before_more_is_written() {
        let text = text(0);
        assert!(text.contains("psi_neo_hookean                  failed, 1 of 3 checks pass"), "{text}");
        assert!(text.contains("✗ check 0") && text.contains("✗ check 2") && !text.contains("check 1"), "{text}");
        assert!(text.contains("1 of 3 functions pass\nnext: src/psi_neo_hookean.rs"), "{text}");
    }

    #[test]
    fn hints_come_in_steps() {
        let [first, second, third] = [0, 1, 2].map(text);
        assert!(first.contains("rule 0") && !first.contains("rule 2") && !first.contains("figures 0"), "{first}");
        assert!(second.contains("rule 2") && second.contains("with input 2"), "{second}");
        assert!(!second.contains("Integer division") && third.contains("Integer division"), "{third}");
    }

    #[test]
    fn a_given_function_that_was_changed_is_put_back_and_one_of_a_later_assignment_is_written_only_where_another_calls_it()
     {
        let folder = Path::new(".");
        let told = |reports: &[Report]| View { hints: 0, colour: false, folder, only_one: false }.render(reports, None);
        let given = Report { role: Role::Given, ..report("phi_linear_tetrahedron", Status::Failed, &[false]) };
        let text = told(&[given]);
        assert!(
            text.contains("0 of 0 functions pass") && text.contains("reset phi_linear_tetrahedron` puts it back"),
            "{text}"
        );

        let later = || Cause { name: "mass_matrix_linear_tetrahedron", status: Status::Missing, role: Role::Later };
        let waiting = Report { waits_for: vec![later()], ..report("T_linear_tetrahedron", Status::Missing, &[false]) };
        let text = told(&[waiting]);
        assert!(text.contains("waits for mass_matrix_linear_tetrahedron\n"), "{text}");
        assert!(text.contains("next: src/mass_matrix_linear_tetrahedron.rs"), "{text}");
        assert!(text.contains("a later assignment asks for it, but T_linear_tetrahedron waits for it"), "{text}");
    }
}
