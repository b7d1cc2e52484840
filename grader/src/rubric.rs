//! `rubric.toml`: points, levels, tolerances and what students see. Data for the instructor to change, not code.

mod deadline;
mod judging;

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use grader::submission::NAMES;
use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

pub use deadline::{Deadline, Extension, Lateness};

/// The rubric that comes with the grader.
const OURS: &str = include_str!("../rubric.toml");

/// How submissions are judged.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rubric {
    /// Whether a function that is right on ordinary inputs keeps the share of checks that it passes.
    pub partial_credit: bool,
    /// Share of its points that a right assembly loses if its time clearly grows faster with the mesh than the reference's.
    #[serde(default)]
    pub growth_costs: f64,
    /// Largest relative error that counts as round-off.
    pub tolerance: f64,
    /// Longest time for one answer, s.
    pub seconds: f64,
    /// Longest processor time for the compiler and one program, s.
    pub compile_seconds: f64,
    /// Longest time for all answers of one check, s.
    #[serde(default = "check_seconds")]
    pub check_seconds: f64,
    /// Longest time for all answers of one function, s.
    #[serde(default = "function_seconds")]
    pub function_seconds: f64,
    /// Longest time for a submission, the compiler's included, s.
    #[serde(default = "submission_seconds")]
    pub submission_seconds: f64,
    pub students: Students,
    pub simulation: Simulation,
    /// Name of the assignment in gradebooks.
    #[serde(default = "title")]
    pub title: String,
    /// The submission of a student that counts.
    #[serde(default)]
    pub counts: Counts,
    /// What a student without a submission gets.
    #[serde(default)]
    pub no_submission: NoSubmission,
    pub deadline: Option<Deadline>,
    /// Later deadlines of single students.
    #[serde(default, rename = "extension")]
    pub extensions: Vec<Extension>,
    /// Functions of a later assignment: neither asked for nor given solved.
    #[serde(default)]
    pub later: Vec<Spanned<String>>,
    /// The functions of this assignment in the order of the reports. All others but the `later` ones are given solved.
    #[serde(rename = "function")]
    pub functions: Vec<Function>,
}

/// The part of a function in an assignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Students write it, and it is graded.
    Asked,
    /// Students receive it solved.
    Given,
    /// Students receive it empty, and it is not graded.
    Later,
}

/// The parts of a grade that students see.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Students {
    pub diagnosis: bool,
    pub hints: bool,
    /// Time from which on `feedback` may be given.
    pub release: Option<deadline::Time>,
}

/// The submission of a student that counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Counts {
    #[default]
    Newest,
    /// The one with the most points, after the penalty for lateness.
    Best,
}

/// What a student on the roster who has submitted nothing gets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NoSubmission {
    #[default]
    Blank,
    Zero,
}

/// The whole simulation.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Simulation {
    pub points: f64,
}

/// One function.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Function {
    pub name: Spanned<String>,
    pub points: Spanned<f64>,
    pub level: Spanned<u32>,
    pub hint: Option<String>,
    /// Instead of the rubric's.
    pub tolerance: Option<f64>,
}

/// Why a rubric cannot be used.
#[derive(Debug, Error)]
pub enum RubricError {
    #[error("{0}: {1}; name a rubric that can be read")]
    Io(PathBuf, std::io::Error),
    #[error("{0}: {1}grader/rubric.toml shows what must stand in a rubric")]
    Toml(PathBuf, toml::de::Error),
    #[error("{file}, line {line}: {problem}")]
    Value { file: PathBuf, line: usize, problem: String },
    #[error("{0}: {1}")]
    Whole(PathBuf, String),
}

impl Rubric {
    /// Reads a rubric; without a path, the one that comes with the grader.
    ///
    /// # Errors
    /// The problem, with its line.
    pub fn load(path: Option<&Path>) -> Result<Self, RubricError> {
        let file = path.unwrap_or(Path::new("rubric.toml"));
        let text = match path {
            None => OURS.to_owned(),
            Some(path) => text(path)?,
        };
        let rubric: Self = toml::from_str(&text).map_err(|error| RubricError::Toml(file.to_owned(), error))?;
        rubric.check(file, &text)?;
        Ok(rubric)
    }

    fn check(&self, file: &Path, text: &str) -> Result<(), RubricError> {
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
        if !(0.0..=1.0).contains(&self.growth_costs) {
            return Err(format!("growth_costs = {}; give a share from 0 to 1", self.growth_costs));
        }
        if !is_points(self.simulation.points) {
            let points = self.simulation.points;
            return Err(format!("points = {points} of [simulation]; give a number from 0 to {MOST_POINTS}"));
        }
        if let Some(deadline) = &self.deadline {
            deadline.check()?;
        }
        if !self.later.is_empty() && self.simulation.points > 0.0 {
            return Err("[simulation] has points, but needs functions that are `later`; give it 0 points".to_owned());
        }
        Ok(())
    }

    /// The part of a function in this assignment.
    pub fn role(&self, name: &str) -> Role {
        if self.functions.iter().any(|function| function.name.get_ref() == name) {
            return Role::Asked;
        }
        if self.later.iter().any(|later| later.get_ref() == name) { Role::Later } else { Role::Given }
    }

    /// All points that can be earned.
    pub fn max_score(&self) -> f64 {
        self.functions.iter().map(|function| *function.points.get_ref()).sum::<f64>() + self.simulation.points
    }

    /// Levels in ascending order.
    pub fn levels(&self) -> Vec<u32> {
        let mut levels: Vec<u32> = self.functions.iter().map(|function| *function.level.get_ref()).collect();
        levels.sort_unstable();
        levels.dedup();
        levels
    }

    /// The level of a function that is asked for.
    pub fn level(&self, name: &str) -> Option<u32> {
        let function = self.functions.iter().find(|function| function.name.get_ref() == name)?;
        Some(*function.level.get_ref())
    }
}

/// Refuses a name that no function has.
fn known(name: &str) -> Result<(), String> {
    if NAMES.contains(&name) {
        return Ok(());
    }
    Err(format!("`{name}` is not a function of the course; the README lists the names"))
}

fn title() -> String {
    "Finite elements".to_owned()
}

fn check_seconds() -> f64 {
    10.0
}

fn function_seconds() -> f64 {
    20.0
}

fn submission_seconds() -> f64 {
    120.0
}

/// More than any exercise is worth, so that sums stay numbers.
const MOST_POINTS: f64 = 1e6;

fn is_points(points: f64) -> bool {
    (0.0..=MOST_POINTS).contains(&points)
}

/// A file as text, or the line that is not UTF-8.
fn text(path: &Path) -> Result<String, RubricError> {
    let bytes = fs::read(path).map_err(|error| RubricError::Io(path.to_owned(), error))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        RubricError::Value { file: path.to_owned(), line, problem: "is not UTF-8 text; save it as UTF-8".to_owned() }
    })
}

#[cfg(test)]
mod tests;
