//! Refuses inconsistent rubrics, and names the line and the remedy.

use std::ops::Range;
use std::path::Path;

use grader::submission::NAMES;

use super::{OwnCheck, Role, Rubric, RubricError};

/// Largest number of points, so that sums stay finite.
const MOST_POINTS: f64 = 1e6;

fn is_points(points: f64) -> bool {
    (0.0..=MOST_POINTS).contains(&points)
}

impl Rubric {
    pub(super) fn check(&self, file: &Path, text: &str) -> Result<(), RubricError> {
        let at = |span: Range<usize>, problem: String| RubricError::Value {
            file: file.to_owned(),
            line: text[..span.start].matches('\n').count() + 1,
            problem,
        };
        for (index, function) in self.functions.iter().enumerate() {
            let name = function.name.get_ref();
            known(name).map_err(|problem| at(function.name.span(), problem))?;
            if self.functions[..index].iter().any(|earlier| earlier.name.get_ref() == name) {
                return Err(at(function.name.span(), format!("`{name}` stands here a second time; remove one")));
            }
            let points = *function.points.get_ref();
            if !is_points(points) {
                return Err(at(
                    function.points.span(),
                    format!("points = {points}; give a number from 0 to {MOST_POINTS}"),
                ));
            }
            if *function.level.get_ref() == 0 {
                return Err(at(function.level.span(), "level = 0; levels count from 1".to_owned()));
            }
        }
        for (index, extension) in self.extensions.iter().enumerate() {
            let earlier = &self.extensions[..index];
            let span = extension.student.span();
            extension.check(self.deadline.as_ref(), earlier).map_err(|problem| at(span, problem))?;
        }
        for check in &self.checks {
            check.check(self).map_err(|problem| at(check.function.span(), problem))?;
        }
        for name in &self.later {
            known(name.get_ref()).map_err(|problem| at(name.span(), problem))?;
            if self.functions.iter().any(|function| function.name.get_ref() == name.get_ref()) {
                let problem = format!("`{}` has a table [[function]] and is `later`; remove one", name.get_ref());
                return Err(at(name.span(), problem));
            }
        }
        self.check_whole().map_err(|problem| RubricError::Whole(file.to_owned(), problem))
    }

    fn check_whole(&self) -> Result<(), String> {
        if self.functions.is_empty() {
            return Err("it asks for no function; add a table [[function]]".to_owned());
        }
        let own =
            self.functions.iter().filter_map(|function| Some((function.name.get_ref().as_str(), function.tolerance?)));
        for (whose, tolerance) in own.chain([("all functions", self.tolerance)]) {
            if !(tolerance > 0.0 && tolerance < 1.0) {
                return Err(format!("tolerance = {tolerance} of {whose}; give a number between 0 and 1, such as 1e-9"));
            }
        }
        for (what, seconds) in [
            ("seconds", self.seconds),
            ("compile_seconds", self.compile_seconds),
            ("check_seconds", self.check_seconds),
            ("function_seconds", self.function_seconds),
            ("submission_seconds", self.submission_seconds),
        ] {
            if !(0.1..=600.0).contains(&seconds) {
                return Err(format!("{what} = {seconds}; give a number from 0.1 to 600"));
            }
        }
        for (what, share) in [("growth_costs", self.growth_costs), ("edge_cases", self.edge_cases)] {
            if !(0.0..=1.0).contains(&share) {
                return Err(format!("{what} = {share}; give a share from 0 to 1"));
            }
        }
        if !is_points(self.simulation.points) {
            let points = self.simulation.points;
            return Err(format!("points = {points} of [simulation]; give a number from 0 to {MOST_POINTS}"));
        }
        if let Some(pages) = &self.students.pages {
            let is_address = pages.starts_with("https://") || pages.starts_with("http://") || !pages.contains(':');
            if !(is_address && pages.contains("{name}")) {
                return Err(format!(
                    "pages = \"{pages}\"; give an address that begins with https:// or a path, with {{name}} in it"
                ));
            }
        }
        if let Some(deadline) = &self.deadline {
            deadline.check()?;
        }
        if !self.later.is_empty() && self.simulation.points > 0.0 {
            return Err("[simulation] has points, but needs functions that are `later`; give it 0 points".to_owned());
        }
        Ok(())
    }
}

impl OwnCheck {
    fn check(&self, rubric: &Rubric) -> Result<(), String> {
        let (function, file) = (self.function.get_ref(), self.file.display());
        if rubric.role(function) != Role::Asked {
            return Err(format!(
                "a [[check]] of `{function}`, which the rubric does not ask for; add a table [[function]]"
            ));
        }
        if self.name.trim().is_empty() || self.name.contains(char::is_control) {
            return Err(format!("the name of the check {file} is no line of text; write the rule as a sentence"));
        }
        if let Some(points) = self.points.filter(|points| !is_points(*points)) {
            return Err(format!("points = {points} of the check {file}; give a number from 0 to {MOST_POINTS}"));
        }
        if rubric.checks.iter().filter(|other| other.function == self.function && other.name == self.name).count() > 1 {
            return Err(format!("`{}` is the name of two checks of `{function}`; rename one", self.name));
        }
        if !self.file.is_file() {
            return Err(format!("{file}: there is no such file; name one beside the rubric"));
        }
        Ok(())
    }
}

/// Refuses a name that no function has.
fn known(name: &str) -> Result<(), String> {
    if NAMES.contains(&name) {
        return Ok(());
    }
    Err(format!("`{name}` is not a function of the course; the README lists the names"))
}
