//! Grades a whole class: every submission of a folder, each in its own process. Grades that are still valid are kept.
//!
//! A finished grade lies complete in `OUT/grades/KEY`, so that grading may be killed at any time and started again.

mod empty;
mod find;
mod folders;
mod key;
mod merge;
mod opened;
mod person;
mod process;
mod regrade;
mod roster;
mod schedule;
mod store;
#[cfg(test)]
mod tests;

use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use crate::assess::Accounts;
use crate::grade::Grade;
use crate::rubric::Counts;
pub use folders::{apart, distinct};
pub use key::Identity;
pub use opened::open;
pub use person::Person;
pub use process::end_with;
pub use regrade::Change;
pub use store::{Index, student_folder};

/// Writes what is known of a class into a folder; called again and again as a run goes on.
pub type Report = fn(&Summary, &Path) -> io::Result<()>;

/// Writes the reports of one student into a folder, with the diagnosis or without.
pub type Write = fn(&Grade, &Path, bool) -> io::Result<()>;

/// Options of the grading of a class.
#[derive(Clone, Debug)]
pub struct ClassOptions {
    /// Folder of the submissions: each sub-folder and each `.zip`, `.tar.gz` or `.tgz` is one; `students.csv` may name students.
    pub folder: PathBuf,
    /// The table of the students in place of `students.csv`, or a platform's roster.
    pub roster: Option<PathBuf>,
    /// Folder of the results, those of earlier runs included.
    pub out: PathBuf,
    /// Number of submissions that are graded at a time; at least one.
    pub jobs: usize,
    /// Part k, from 1, of n: the students whose names fall into it.
    pub shard: Option<(usize, usize)>,
    pub seed: u64,
    /// Called as `GRADER grade SUBMISSION --out DIR --seed N --ends-with PID EXTRA…`, PID being this process.
    pub grader: PathBuf,
    /// Limit of wall-clock time for a submission, after which it is given up.
    pub time_limit: Duration,
    /// Passed to the grader as `--rubric FILE`.
    pub rubric: Option<PathBuf>,
    /// The rubric with adjustments by hand. The part of it that judges decides whether an earlier grade still counts.
    pub accounts: Accounts,
    /// Students or submissions to grade again; all others stay as they are. Empty: every submission that has no grade yet.
    pub only: Vec<String>,
    /// Functions to grade again, the others' results being kept. Empty: all.
    pub functions: Vec<String>,
    /// Further arguments for the grader.
    pub extra: Vec<String>,
    /// Writes what people read of a class: tables, pages.
    pub report: Report,
    pub write: Write,
}

/// A class as far as it is graded.
#[derive(Clone, Debug)]
pub struct Summary {
    pub identity: Identity,
    pub shard: Option<(usize, usize)>,
    /// By name of the student, then of the submission.
    pub entries: Vec<Entry>,
    /// The students that `students.csv` names.
    pub people: Vec<Person>,
    /// Name of the assignment in gradebooks.
    pub title: String,
    pub max_score: f64,
    /// Time from which on students may have their reports, in UTC.
    pub release: Option<String>,
    /// Points that differ from those of the previous run.
    pub changes: Vec<Change>,
    /// Remarks for the instructor: other files, students that may be one, conflicts, …
    pub remarks: Vec<String>,
    /// Number of submissions that this run graded.
    pub graded_now: usize,
    /// Number of submissions that earlier runs had graded.
    pub kept: usize,
    /// The run was interrupted before its end.
    pub interrupted: bool,
}

/// One submission of a class.
#[derive(Clone, Debug)]
pub struct Entry {
    /// File name of the folder or archive, without the ending where that is unique.
    pub submission: String,
    pub student: String,
    pub outcome: Outcome,
}

/// Outcome of a submission. Only a graded one has a score; a missing score is not zero.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// The grade, and the folder of its reports relative to the output.
    Graded(Box<Grade>, PathBuf),
    /// No grade; the reason.
    NotGraded(String),
    /// Not graded yet.
    Waiting,
    /// Another submission of the same student counts: a newer one, or a better one.
    Older { newer: String },
    /// A student of the roster has submitted nothing; the score, if that is one.
    NoSubmission(Option<f64>),
}

/// Errors of the grading of a class, and of joining its parts.
#[derive(Debug, thiserror::Error)]
pub enum ClassError {
    #[error("{path}: {source}", path = path.display())]
    File { path: PathBuf, source: io::Error },
    #[error("{path}: {message}", path = path.display())]
    Unreadable { path: PathBuf, message: String },
    #[error(
        "{path}: names no student; give a roster of Canvas, Moodle or Gradescope as it comes, or a table with a column `student`",
        path = .0.display()
    )]
    NoStudents(PathBuf),
    #[error("{path}: {source}; --roster takes the path of a roster as the platform gives it", path = path.display())]
    NoRoster { path: PathBuf, source: io::Error },
    #[error("{0}: another run is at work there; wait for it or name another folder")]
    Locked(String),
    #[error("shard {0}/{1}: the first figure runs from 1 to the second")]
    Shard(usize, usize),
    #[error("rustc --version: {0}; install the toolchain or put it on the PATH")]
    Toolchain(String),
    #[error("{first} and {second} do not belong together: their {what} differ", first = first.display(), second = second.display())]
    Mismatch { first: PathBuf, second: PathBuf, what: &'static str },
    #[error("{path}: {source}; name a folder with submissions in it", path = path.display())]
    NoClass { path: PathBuf, source: io::Error },
    #[error("{path}: {source}; name folders that `class` has written", path = path.display())]
    NoResults { path: PathBuf, source: io::Error },
    #[error("{path}: lies where {what}; name another folder for the results", path = path.display())]
    InTheWay { path: PathBuf, what: &'static str },
    #[error("`{0}` is neither a student nor a submission of this class; --only takes their names")]
    NoSuchSubmission(String),
    #[error("name at least one folder to merge")]
    Nothing,
    #[error("the report: {0}")]
    Report(io::Error),
}

/// Adds the path that an error of the file system is about.
fn at(path: &Path) -> impl FnOnce(io::Error) -> ClassError {
    let path = path.to_path_buf();
    move |source| ClassError::File { path, source }
}

/// The shard of a class that a run grades.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shard {
    k: usize,
    n: usize,
}

/// Grades what is not graded yet. Failures of single submissions are in the summary; an error is about the run itself.
pub fn run(options: &ClassOptions) -> Result<Summary, ClassError> {
    if let Some((k, n)) = options.shard
        && !(1..=n).contains(&k)
    {
        return Err(ClassError::Shard(k, n));
    }
    let rubric = options.accounts.rubric();
    let mut class = find::class(&options.folder, options.roster.as_deref(), rubric.counts)?;
    class.remarks.extend(roster::strangers(options, &class)?);
    if let Some((k, n)) = options.shard {
        class.submissions.retain(|submission| key::shard(&submission.student, n) == k);
        class.people.retain(|person| key::shard(&person.student, n) == k);
    }
    let identity = Identity::of(&options.grader, options.seed, rubric, &options.extra)?;
    let store = store::Store::open(&options.out)?;
    // Before hours of grading, because a wrong roster is best mended first.
    class.remarks.iter().for_each(|remark| eprintln!("note: {remark}"));
    schedule::grade(options, class, identity, &store)
}

/// A submission as it lies in a folder, with its student or the students of its group.
pub struct Listed {
    pub submission: String,
    pub path: PathBuf,
    pub students: Vec<String>,
}

/// All submissions of a folder.
pub struct List {
    pub submissions: Vec<Listed>,
    /// Remarks on what else is there.
    pub remarks: Vec<String>,
    /// The folders of submissions that came as single files, which last as long as this value.
    _gathered: Option<TempDir>,
}

/// Lists the submissions of a folder. A roster takes the place of all tables in it.
pub fn list(folder: &Path, roster: Option<&Path>) -> Result<List, ClassError> {
    let class = find::class(folder, roster, Counts::Best)?;
    let mut listed: Vec<Listed> = Vec::new();
    for found in class.submissions {
        match listed.iter_mut().find(|listed| listed.path == found.path) {
            Some(group) => group.students.push(found.student),
            None => listed.push(Listed { submission: found.name, path: found.path, students: vec![found.student] }),
        }
    }
    Ok(List { submissions: listed, remarks: class.remarks, _gathered: class.gathered })
}

/// Folders of the reports for the graded students of a class, and their release time.
pub fn handed_back(results: &Path) -> Result<(Vec<PathBuf>, Option<String>), ClassError> {
    let index = store::Index::read(results)?;
    let graded = index.submissions.into_iter().filter(|row| matches!(row.state, store::IndexState::Graded(_)));
    let mut folders: Vec<PathBuf> = graded.map(|row| results.join(student_folder(&row.student))).collect();
    folders.dedup();
    Ok((folders, index.release))
}

/// Joins the outputs `dirs` of shards into `out`, with copies of the reports.
///
/// They must come from one grader, toolchain and seed. A submission that was graded in two of them with two results is a
/// conflict and gets no grade, and so is a student for whom two submissions count.
pub fn merge(dirs: &[PathBuf], out: &Path, report: Report) -> Result<Summary, ClassError> {
    merge::join(dirs, out, report)
}
