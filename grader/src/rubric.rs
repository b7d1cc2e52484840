//! `rubric.toml`: points, levels, tolerances and what students see. Data for the instructor to change, not code.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use grader::compile::names;
use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

/// The rubric that comes with the grader.
const OURS: &str = include_str!("../rubric.toml");

/// How submissions are judged.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rubric {
    /// Whether a function that is right on ordinary inputs keeps the share of checks that it passes.
    pub partial_credit: bool,
    /// Largest relative error that counts as round-off.
    pub tolerance: f64,
    /// Longest time for one answer, s.
    pub seconds: f64,
    pub students: Students,
    pub simulation: Simulation,
    /// The functions in the order of the reports.
    #[serde(rename = "function")]
    pub functions: Vec<Function>,
}

/// What students see.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Students {
    pub diagnosis: bool,
    pub hints: bool,
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
    #[error("{0}: {1}")]
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
    /// What is wrong, with the line.
    pub fn load(path: Option<&Path>) -> Result<Self, RubricError> {
        let file = path.unwrap_or(Path::new("rubric.toml"));
        let text = match path {
            None => OURS.to_owned(),
            Some(path) => fs::read_to_string(path).map_err(|error| RubricError::Io(path.to_owned(), error))?,
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
            if !names().any(|known| known == name) {
                let problem = format!("`{name}` is no function of the course; the README lists their names");
                return Err(at(function.name.span(), problem));
            }
            if self.functions[..index].iter().any(|earlier| earlier.name.get_ref() == name) {
                return Err(at(function.name.span(), format!("`{name}` stands here a second time; remove one")));
            }
            let points = *function.points.get_ref();
            if !(points.is_finite() && points >= 0.0) {
                return Err(at(
                    function.points.span(),
                    format!("points = {points}; give a number that is not negative"),
                ));
            }
            if *function.level.get_ref() == 0 {
                return Err(at(function.level.span(), "level = 0; levels count from 1".to_owned()));
            }
        }
        let whole = |problem: &str| Err(RubricError::Whole(file.to_owned(), problem.to_owned()));
        if let Some(missing) =
            names().find(|name| !self.functions.iter().any(|function| function.name.get_ref() == name))
        {
            return whole(&format!(
                "`{missing}` is missing; add a table [[function]] for it, with 0 points if it is not asked for"
            ));
        }
        let tolerances = self.functions.iter().filter_map(|function| function.tolerance).chain([self.tolerance]);
        if tolerances.into_iter().any(|tolerance| !(tolerance > 0.0 && tolerance < 1.0)) {
            return whole("a `tolerance` is not between 0 and 1");
        }
        if !(self.seconds > 0.0 && self.seconds <= 600.0) {
            return whole("`seconds` is not between 0 and 600");
        }
        if !(self.simulation.points.is_finite() && self.simulation.points >= 0.0) {
            return whole("`points` of [simulation] is negative or no number");
        }
        Ok(())
    }

    /// Levels in ascending order.
    pub fn levels(&self) -> Vec<u32> {
        let mut levels: Vec<u32> = self.functions.iter().map(|function| *function.level.get_ref()).collect();
        levels.sort_unstable();
        levels.dedup();
        levels
    }

    /// The level of a function.
    pub fn level(&self, name: &str) -> u32 {
        let function = self.functions.iter().find(|function| function.name.get_ref() == name);
        function.map_or(1, |function| *function.level.get_ref())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(text: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rubric.toml");
        fs::write(&path, text).unwrap();
        Rubric::load(Some(&path)).unwrap_err().to_string()
    }

    #[test]
    fn our_rubric_is_worth_100_points_and_names_every_function() {
        let rubric = Rubric::load(None).unwrap();
        assert_eq!(rubric.functions.iter().map(|function| function.points.get_ref()).sum::<f64>(), 100.0);
        assert_eq!(rubric.functions.len(), 22);
        assert_eq!(rubric.levels(), [1, 2, 3, 4]);
    }

    #[test]
    fn mistakes_are_named_with_their_line() {
        let unknown = OURS.replacen("name = \"psi_neo_hookean\"", "name = \"psi_neo_hooke\"", 1);
        let line = OURS.lines().position(|line| line == "name = \"psi_neo_hookean\"").unwrap() + 1;
        assert!(
            problem(&unknown).contains(&format!("line {line}: `psi_neo_hooke` is no function")),
            "{}",
            problem(&unknown)
        );
        assert!(problem(&OURS.replacen("points = 4.0", "points = -4.0", 1)).contains("points = -4"));
        assert!(problem(&OURS.replacen("points = 4.0", "points = \"four\"", 1)).contains("line "));
        assert!(problem(&OURS.replacen("hints = true", "hint = true", 1)).contains("hint"));
        assert!(problem(&OURS.replacen("tolerance = 1e-9", "tolerance = nan", 1)).contains("tolerance"));
        let twice = format!("{OURS}\n[[function]]\nname = \"psi_neo_hookean\"\npoints = 1.0\nlevel = 1\n");
        assert!(problem(&twice).contains("second time"));
    }
}
