//! Grades one submission: builds its functions level by level, runs the checks of each, and looks for a mistake that explains a failure.

mod exposure;
mod groups;
mod growth;
mod judge;
mod level;
mod load;
mod programs;
mod regrade;
mod study;
mod timer;
mod truth;
mod whole;
mod workspace;

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Duration;

use grader::compile::BuildError;
use grader::compile::prebuilt::{PrebuildError, Prebuilt};
use grader::implementation::budget::Budget;
use grader::implementation::sandboxed::Sandboxed;
use grader::sandbox::Sandbox;
use grader::status::Status;
use grader::submission::{LATER, Source, Submission};
use thiserror::Error;

use crate::grade::{FORMAT_VERSION, FunctionGrade, Grade};
use crate::handout::unmarked;
use crate::rubric::{Function, Role, Rubric};
use exposure::exposed;
use programs::Programs;
use timer::CpuTimer;
use workspace::Workspace;

/// Errors of the grader or its machine, in place of a grade.
#[derive(Debug, Error)]
pub enum GradingError {
    #[error(transparent)]
    Prebuild(#[from] PrebuildError),
    #[error(transparent)]
    Build(#[from] BuildError),
    #[error("{0}; the grader needs a folder to work in and a compiler to start")]
    Io(#[from] io::Error),
    #[error("{} lies in {}, which the compiler of a submission can read; move the repository elsewhere", .0.display(), .1.display())]
    Exposed(PathBuf, PathBuf),
    #[error("the reference itself gives no answer ({0}); something is wrong with this machine or with the sandbox")]
    Reference(String),
}

/// Data that are prepared once for all submissions.
pub struct Grading {
    rubric: Rubric,
    prebuilt: Prebuilt,
    sandbox: Sandbox,
    programs: Programs,
    /// All functions of the reference, to take their times.
    reference: Sandboxed,
    seed: u64,
    workspace: Workspace,
    /// Run the simulation at several time steps.
    studies: bool,
}

impl Grading {
    /// Prepares libraries and the reference's own program from the repository at `root`.
    ///
    /// # Errors
    /// The reason if the reference does not compile.
    pub fn new(
        root: &Path,
        rubric: Rubric,
        (sandbox, tools): (Sandbox, Sandbox),
        seed: u64,
    ) -> Result<Self, GradingError> {
        let prebuilt = Prebuilt::new(root, tools)?;
        let programs = Programs::new(root, &rubric, &prebuilt)?;
        let secrets = [root.join("src"), root.join("grader"), programs.whole()];
        if sandbox.is_some_layer()
            && let Some((secret, folder)) = exposed(&prebuilt.readable(), &secrets)
        {
            return Err(GradingError::Exposed(secret.to_owned(), folder.to_owned()));
        }
        let limit = Duration::from_secs_f64(rubric.seconds);
        let reference = Sandboxed::new(programs.start_reference(&sandbox), limit);
        Ok(Self { rubric, prebuilt, sandbox, programs, reference, seed, workspace: Workspace::new()?, studies: false })
    }

    /// The same, with a study of error against run time in each grade.
    pub fn with_study(self) -> Self {
        Self { studies: true, ..self }
    }

    /// Grades a submission.
    ///
    /// # Errors
    /// An error of the grader, never of the submission.
    pub fn grade(&self, submission: &Submission) -> Result<Grade, GradingError> {
        let timer = CpuTimer::start();
        let hash = submission.hash();
        let submission = &self.as_assigned(submission);
        let mut graded = BTreeMap::new();
        for function in &self.rubric.functions {
            if let Some(grade) = without_running(function, submission) {
                graded.insert(function.name.get_ref().clone(), grade);
            }
        }
        // From the top level down: functions of the lowest level, which call no others, are judged in the program of the whole
        // simulation. That program is built only if all levels above compile.
        let levels = self.rubric.levels();
        let budget = Rc::new(self.budget());
        for level in levels.iter().skip(1).rev() {
            self.grade_level(*level, submission, None, &mut graded, &budget)?;
        }
        let whole = self.whole(submission, &graded, &budget)?;
        if let Some(level) = levels.first() {
            self.grade_level(*level, submission, whole.as_ref(), &mut graded, &budget)?;
        }
        let simulation = self.grade_simulation(whole.as_ref(), &graded, &budget)?;
        let study = self.studies.then(|| self.study(whole.as_ref(), &simulation, &budget)).transpose()?;
        let functions: Vec<FunctionGrade> =
            self.rubric.functions.iter().filter_map(|function| graded.remove(function.name.get_ref())).collect();
        let parts = || functions.iter().chain([&simulation]);
        let grade = Grade {
            format_version: FORMAT_VERSION,
            submission: submission.name.clone(),
            files: hash,
            score: parts().map(|part| part.score).sum(),
            max_score: parts().map(|part| part.max_score).sum(),
            seed: self.seed,
            toolchain: self.prebuilt.toolchain.clone(),
            sandbox: self.sandbox.layers(),
            remarks: self.remarks(submission, &budget),
            functions,
            simulation,
            account: None,
            pages: self.rubric.students.pages.clone(),
            study,
            seconds: timer.seconds(),
        };
        Ok(grade.bounded())
    }

    /// The submission with the reference in place of what is given solved, and without what a later assignment asks for.
    fn as_assigned(&self, submission: &Submission) -> Submission {
        let mut assigned = submission.clone();
        for (name, source) in &mut assigned.functions {
            match self.rubric.role(name) {
                Role::Asked => {}
                Role::Later => *source = Source::Missing(LATER.to_owned()),
                Role::Given => {
                    let text = self.programs.text(name).cloned().unwrap_or_default();
                    if matches!(source, Source::Written(own) if unmarked(own) != text) {
                        assigned.remarks.push(format!("src/{name}.rs is given solved; the changes in it do not count"));
                    }
                    *source = Source::Written(text);
                }
            }
        }
        assigned
    }

    fn budget(&self) -> Budget {
        let Rubric { check_seconds, function_seconds, submission_seconds, .. } = self.rubric;
        let [check, function, whole] =
            [check_seconds, function_seconds, submission_seconds].map(Duration::from_secs_f64);
        Budget::new(check, function, whole)
    }

    fn remarks(&self, submission: &Submission, budget: &Budget) -> Vec<String> {
        let seconds = self.rubric.submission_seconds;
        let late = format!("the submission took longer than {seconds} s in all; what was left was not waited for");
        submission.remarks.iter().cloned().chain(budget.is_used_up().then_some(late)).collect()
    }

    fn limit(&self) -> Duration {
        Duration::from_secs_f64(self.rubric.seconds)
    }

    fn compile_limit(&self) -> Duration {
        Duration::from_secs_f64(self.rubric.compile_seconds)
    }
}

/// The grade of a function that is missing or not allowed, for which no program is built.
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
        location: None,
        message,
        hint: function.hint.clone(),
        error: None,
        seconds: None,
        reference_seconds: None,
        growth: None,
        checks: Vec::new(),
    }
}

/// The repository that this program was built from.
pub fn repository() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_owned()
}
