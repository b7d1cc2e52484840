//! Grades one submission: builds its functions level by level, holds each to its checks, and asks which mistake explains a failure.

mod judge;
mod load;
mod programs;
mod whole;

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use grader::compile::prebuilt::{PrebuildError, Prebuilt};
use grader::compile::{Plan, build, names};
use grader::implementation::sandboxed::Sandboxed;
use grader::sandbox::Sandbox;
use grader::status::Status;
use grader::submission::{Source, Submission};
use thiserror::Error;

use crate::grade::{FORMAT_VERSION, FunctionGrade, Grade};
use crate::rubric::{Function, Rubric};
use programs::{Programs, start};

/// Trouble of the grader or its machine; never a grade.
#[derive(Debug, Error)]
pub enum GradingError {
    #[error(transparent)]
    Prebuild(#[from] PrebuildError),
    #[error("{0}; the grader needs a folder to work in and a compiler to start")]
    Io(#[from] io::Error),
    #[error("the reference itself gives no answer ({0}); something is wrong with this machine or with the sandbox")]
    Reference(String),
}

/// Everything that is prepared once, for all submissions.
pub struct Grading {
    rubric: Rubric,
    prebuilt: Prebuilt,
    sandbox: Sandbox,
    programs: Programs,
    seed: u64,
}

impl Grading {
    /// Prepares libraries and the reference's own program from the repository at `root`.
    ///
    /// # Errors
    /// Where something of ours does not compile.
    pub fn new(root: &Path, rubric: Rubric, sandbox: Sandbox, seed: u64) -> Result<Self, GradingError> {
        let prebuilt = Prebuilt::new(root)?;
        let programs = Programs::new(root, &rubric, &prebuilt)?;
        Ok(Self { rubric, prebuilt, sandbox, programs, seed })
    }

    /// Grades a submission.
    ///
    /// # Errors
    /// Trouble of the grader, not of the submission.
    pub fn grade(&self, submission: &Submission) -> Result<Grade, GradingError> {
        let begin = Instant::now();
        let mut graded = BTreeMap::new();
        for function in &self.rubric.functions {
            if let Some(grade) = without_running(function, submission) {
                graded.insert(function.name.get_ref().clone(), grade);
            }
        }
        for level in self.rubric.levels() {
            self.grade_level(level, submission, &mut graded)?;
        }
        let simulation = self.grade_simulation(submission, &graded)?;
        let functions: Vec<FunctionGrade> =
            self.rubric.functions.iter().filter_map(|function| graded.remove(function.name.get_ref())).collect();
        let parts = || functions.iter().chain([&simulation]);
        Ok(Grade {
            format_version: FORMAT_VERSION,
            submission: submission.name.clone(),
            files: submission.hash(),
            score: parts().map(|part| part.score).sum(),
            max_score: parts().map(|part| part.max_score).sum(),
            seed: self.seed,
            toolchain: self.prebuilt.toolchain.clone(),
            sandbox: self.sandbox.layers(),
            remarks: submission.remarks.clone(),
            functions,
            simulation,
            seconds: begin.elapsed().as_secs_f64(),
        })
    }

    fn limit(&self) -> Duration {
        Duration::from_secs_f64(self.rubric.seconds)
    }

    fn grade_level(
        &self,
        level: u32,
        submission: &Submission,
        graded: &mut BTreeMap<String, FunctionGrade>,
    ) -> Result<(), GradingError> {
        let judged: Vec<&Function> = self
            .rubric
            .functions
            .iter()
            .filter(|function| *function.level.get_ref() == level && !graded.contains_key(function.name.get_ref()))
            .collect();
        if judged.is_empty() {
            return Ok(());
        }
        let below: BTreeSet<&'static str> = names().filter(|name| self.rubric.level(name) < level).collect();
        let own = self.with_what_they_call(&judged, &below, submission);
        let folder = work_folder()?;
        let plan = Plan { own, reference: self.programs.below(level).map(|library| (library, below)) };
        let built = build(&self.prebuilt, &self.sandbox, &plan, folder.path())?;
        let subject = Sandboxed::new(start(&self.sandbox, built.program.clone(), folder.path()), self.limit());
        for function in judged {
            let name = function.name.get_ref();
            let grade = match built.faults.get(name.as_str()) {
                Some(fault) => {
                    finished(function, Status::DidNotCompile, Some(format!("the file does not compile:\n{fault}")))
                }
                None => self.judge(function, &subject)?,
            };
            graded.insert(name.clone(), grade);
        }
        Ok(())
    }

    /// The texts of some functions, and of the student's others that they call and that are not in the reference below.
    fn with_what_they_call(
        &self,
        judged: &[&Function],
        below: &BTreeSet<&'static str>,
        submission: &Submission,
    ) -> BTreeMap<&'static str, String> {
        let mut own = BTreeMap::new();
        let mut wanted: Vec<&'static str> =
            names().filter(|name| judged.iter().any(|function| function.name.get_ref() == name)).collect();
        while let Some(name) = wanted.pop() {
            let Some(Source::Written(text)) = submission.functions.get(name) else { continue };
            if own.insert(name, text.clone()).is_none() {
                wanted.extend(names().filter(|other| *other != name && !below.contains(other) && text.contains(other)));
            }
        }
        own
    }
}

/// A function that is not there or not allowed needs no program.
fn without_running(function: &Function, submission: &Submission) -> Option<FunctionGrade> {
    match submission.functions.get(function.name.get_ref().as_str()) {
        Some(Source::Written(_)) => None,
        Some(Source::Refused { line, reason }) => {
            let place = line.map_or_else(String::new, |line| format!("line {line}: "));
            Some(finished(function, Status::Refused, Some(format!("{place}{reason}"))))
        }
        Some(Source::Missing(why)) => Some(finished(function, Status::Missing, Some(why.clone()))),
        None => Some(finished(function, Status::Missing, None)),
    }
}

/// A grade without points and without checks.
fn finished(function: &Function, status: Status, message: Option<String>) -> FunctionGrade {
    FunctionGrade {
        name: function.name.get_ref().clone(),
        score: 0.0,
        max_score: *function.points.get_ref(),
        status,
        diagnosis: None,
        message,
        hint: function.hint.clone(),
        error: None,
        seconds: None,
        reference_seconds: None,
        checks: Vec::new(),
    }
}

/// A folder for one program, removed in the end.
fn work_folder() -> io::Result<tempfile::TempDir> {
    tempfile::Builder::new().prefix("grader-").tempdir()
}

/// The repository that this program was built from.
pub fn repository() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_owned()
}
