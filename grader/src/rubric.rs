//! `rubric.toml`: points, levels, tolerances and what students see. Data for the instructor to change, not code.

mod checked;
mod deadline;
mod judging;
mod needs;
mod worth;

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

pub use deadline::{Deadline, Extension, Lateness};
pub use worth::Worth;

/// The rubric that comes with the grader.
const OURS: &str = include_str!("../rubric.toml");

/// Size of the largest rubric, bytes: the tree of a text takes about a hundred times its memory.
const MOST_BYTES: u64 = 1 << 20;

/// Rules by which submissions are graded.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rubric {
    /// A function that is right on ordinary inputs keeps the shares of the checks that it passes.
    pub partial_credit: bool,
    /// Largest share of a function's points that its edge cases have together.
    #[serde(default = "edge_cases")]
    pub edge_cases: f64,
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
    /// Points of a student without a submission.
    #[serde(default)]
    pub no_submission: NoSubmission,
    pub deadline: Option<Deadline>,
    /// Later deadlines of single students.
    #[serde(default, rename = "extension")]
    pub extensions: Vec<Extension>,
    /// Functions of a later assignment: neither asked for nor given solved.
    #[serde(default)]
    pub later: Vec<Spanned<String>>,
    /// Checks of the instructor's own.
    #[serde(default, rename = "check")]
    pub checks: Vec<OwnCheck>,
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
    /// Address of the page of a function, with `{name}` in place of its name. Unless given, `include-docs/{name}.md` in the students'
    /// repository.
    pub pages: Option<String>,
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

/// Points of a student on the roster who has submitted nothing.
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
    /// Points of the function. Those of the instructor's own checks are added when the rubric is loaded.
    pub points: Spanned<f64>,
    pub level: Spanned<u32>,
    pub hint: Option<String>,
    /// Instead of the rubric's.
    pub tolerance: Option<f64>,
}

/// A check of the instructor's own, as a Rust file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnCheck {
    /// The function that it judges.
    pub function: Spanned<String>,
    /// The rule as a sentence, which students read.
    pub name: String,
    /// The file, beside the rubric.
    pub file: PathBuf,
    /// Points of its own, on top of the function's. Without them it counts like any other check of the function.
    pub points: Option<f64>,
}

/// Errors in a rubric.
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
        let mut rubric: Self = toml::from_str(&text).map_err(|error| RubricError::Toml(file.to_owned(), error))?;
        let folder =
            path.and_then(|path| std::path::absolute(path).ok()?.parent().map(Path::to_owned)).unwrap_or_default();
        rubric.checks.iter_mut().for_each(|check| check.file = folder.join(&check.file));
        rubric.check(file, &text)?;
        for function in &mut rubric.functions {
            let own = rubric.checks.iter().filter(|check| check.function.get_ref() == function.name.get_ref());
            *function.points.get_mut() += own.filter_map(|check| check.points).sum::<f64>();
        }
        Ok(rubric)
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

    /// The checks of a function that have points of their own.
    pub fn own_points(&self, name: &str) -> Vec<(&str, f64)> {
        let own = self.checks.iter().filter(|check| check.function.get_ref() == name);
        own.filter_map(|check| Some((check.name.as_str(), check.points?))).collect()
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

fn edge_cases() -> f64 {
    0.2
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

/// A file as text, or the line that is not UTF-8.
fn text(path: &Path) -> Result<String, RubricError> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes));
    read.map_err(|error| RubricError::Io(path.to_owned(), error))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(RubricError::Whole(
            path.to_owned(),
            format!("has more than {MOST_BYTES} bytes, which no rubric needs"),
        ));
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        RubricError::Value { file: path.to_owned(), line, problem: "is not UTF-8 text; save it as UTF-8".to_owned() }
    })
}

#[cfg(test)]
mod tests;
