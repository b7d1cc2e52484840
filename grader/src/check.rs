//! The public checks on a student's own machine: every function of a repository, those that do not compile included.

mod confined;
mod found;
mod judged;
mod next;
mod program;
mod recorded;
mod report;
mod reset;
mod roles;
mod run_checks;
mod view;
mod waiting;
mod watch;

use std::collections::BTreeMap;
use std::env;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use thiserror::Error;

use crate::compile::prebuilt::{PrebuildError, Prebuilt};
use crate::compile::{BuildError, Plan, build};
use crate::implementation::sandboxed::Sandboxed;
use crate::properties::FUNCTIONS;
use crate::sandbox::{Isolation, Sandbox};
use crate::status::Status;
use crate::submission::{NAMES, Source, Submission, Unreadable};
use confined::{own_repository, sandbox, starter};
pub use found::{Found, Judged};
pub use judged::Judge;
pub use next::{Next, next};
pub use program::{Options, main};
pub use report::{Cause, Checked, Report};
pub use reset::HANDED_OUT;
pub use roles::{Role, Roles, roles};
pub use view::View;
pub use waiting::reports;
use watch::watch;

/// Seed of the random inputs; the same in every run, so that a corrected function shows.
const SEED: u64 = 2024;

/// Longest time for one answer.
const LIMIT: Duration = Duration::from_secs(5);

/// Longest processor time for the compiler; all functions together take it some seconds.
const COMPILE_LIMIT: Duration = Duration::from_secs(20);

/// Reason why no function can be checked.
#[derive(Debug, Error)]
pub enum CheckError {
    /// The libraries could not be built.
    #[error(transparent)]
    Prebuild(#[from] PrebuildError),
    /// The folder holds no repository.
    #[error("{}: {reason}; name the repository, a folder with `src` in it", .folder.display())]
    Unreadable {
        /// The folder.
        folder: PathBuf,
        /// The problem.
        reason: Unreadable,
    },
    /// No file can be written, no program started.
    #[error("{0}; the checks need a folder to work in and a compiler to start")]
    Io(#[from] io::Error),
    /// The compiler breaks down.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A name that no function has.
    #[error("`{0}` is not a function of the course; {similar}", similar = similar(.0))]
    Unknown(String),
    /// The folder belongs to another user, and this machine has no sandbox.
    #[error("{0}; add `--without-sandbox` if you trust the functions as you trust yourself")]
    Unconfined(Isolation),
    /// No file as it was handed out.
    #[error("{}: {error}; `reset` works in a repository that `handout` wrote", .path.display())]
    NotHandedOut {
        /// The file.
        path: PathBuf,
        /// The problem.
        error: io::Error,
    },
    /// Functions do not pass, and `--exit-code` asks for it.
    #[error("functions that do not pass: {0}")]
    Open(usize),
    /// Saved files cannot be noticed.
    #[error("{0}; run `check` without `--watch`")]
    Watch(#[from] notify::Error),
}

impl CheckError {
    /// 1 the checks themselves failed, 2 an argument is to blame, 3 functions do not pass.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Unknown(_) | Self::Unreadable { .. } | Self::NotHandedOut { .. } => 2,
            Self::Open(_) => 3,
            _ => 1,
        }
    }
}

/// The functions whose names contain a text, a file's ending aside.
fn similar(text: &str) -> String {
    let stem = text.rsplit('/').next().unwrap_or(text).trim_end_matches(".rs").to_lowercase();
    let found: Vec<_> =
        NAMES.into_iter().filter(|name| !stem.is_empty() && name.to_lowercase().contains(&stem)).collect();
    if found.is_empty() {
        "the README lists the names".to_owned()
    } else {
        format!("do you mean {}?", found.join(" or "))
    }
}

/// Checks the functions of the repository at `folder`, or one of them, without a sandbox.
///
/// # Errors
/// The reason if no function can be checked; a function that fails is not an error.
pub fn check(folder: &Path, only: Option<&str>) -> Result<Vec<Report>, CheckError> {
    check_in(&Sandbox::none(), folder, only)
}

/// The same with the functions in a sandbox.
///
/// # Errors
/// The reason if no function can be checked.
pub fn check_in(sandbox: &Sandbox, folder: &Path, only: Option<&str>) -> Result<Vec<Report>, CheckError> {
    let (_, only) = usable(folder, only)?;
    let (judged, roles) = judged_in(sandbox, folder, only.map_or(What::All, What::One))?;
    Ok(reports(&judged, &roles, only))
}

/// The functions to judge.
enum What {
    All,
    One(&'static str),
    /// Those that may answer otherwise now that this one has changed.
    Changed(&'static str, Judged),
}

/// Compiles and judges the functions of a repository.
fn judged_in(sandbox: &Sandbox, folder: &Path, what: What) -> Result<(Judged, Roles), CheckError> {
    let (submission, _) = usable(folder, None)?;
    let bar = bar();
    // A sandbox with layers needs a program that can start as its launcher.
    let tools = if sandbox.is_some_layer() { Sandbox::own_tools(&env::current_exe()?) } else { Sandbox::none() };
    let prebuilt = Prebuilt::new(&own_repository(), tools)?;
    bar.set_message("compiling");
    let work = tempfile::Builder::new().prefix("check-").tempdir_in(&prebuilt.folder)?;
    let built = build(&prebuilt, sandbox, &plan(&submission), work.path())?;
    let start = |program: Option<PathBuf>| Sandboxed::new(starter(sandbox, program, work.path().to_owned()), LIMIT);
    // Two processes, because a check may need another function while the one that it judges is not done.
    let (subject, trusted) = (start(built.program.clone()), start(built.program.clone()));
    let begins = |name| {
        bar.inc(1);
        bar.set_message(name);
    };
    let judge =
        Judge { submission: &submission, faults: &built.faults, subject: &subject, trusted: &trusted, begins: &begins };
    let judged = match what {
        What::All => judge.all(),
        What::One(name) => judge.one(name),
        What::Changed(name, earlier) => judge.after_a_change(earlier, name),
    };
    bar.finish_and_clear();
    Ok((judged, roles(folder, &submission)))
}

/// Reads the functions of a repository, and finds the one to be checked by its name.
fn usable(folder: &Path, only: Option<&str>) -> Result<(Submission, Option<&'static str>), CheckError> {
    let known = |only: &str| FUNCTIONS.iter().map(|(name, _)| *name).find(|name| *name == only);
    let only = only.map(|only| known(only).ok_or_else(|| CheckError::Unknown(only.to_owned()))).transpose()?;
    let read = Submission::read_folder(folder);
    let submission = read.map_err(|reason| CheckError::Unreadable { folder: folder.to_owned(), reason })?;
    Ok((submission, only))
}

/// A progress bar, shown on terminals only and removed at the end.
fn bar() -> ProgressBar {
    let bar = ProgressBar::new(FUNCTIONS.len() as u64 + 1);
    if let Ok(style) = ProgressStyle::with_template("{bar:22} {msg}") {
        bar.set_style(style);
    }
    bar.set_message("preparing libraries; the first time takes a minute");
    bar.tick();
    bar
}

fn refused(line: Option<usize>, reason: &str) -> String {
    line.map_or_else(|| reason.to_owned(), |line| format!("line {line}: {reason}"))
}

fn plan(submission: &Submission) -> Plan {
    let written = submission.functions.iter().filter_map(|(name, source)| match source {
        Source::Written(text) => Some((*name, text.clone())),
        _ => None,
    });
    Plan { own: written.collect(), reference: None, helpers: BTreeMap::new(), limit: COMPILE_LIMIT }
}

/// Prints what was found: a table, and the function to work on next: `about`, or else the first that is to be mended or written.
fn show(options: &Options, reports: &[Report], about: Option<&str>) {
    let is_terminal = io::stdout().is_terminal();
    let colour = is_terminal && env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let view = View { hints: options.hint, colour, folder: &options.folder, only_one: options.only.is_some() };
    let text = view.render(reports, about);
    // Clears the screen and what was scrolled away.
    let clear = if options.watch && is_terminal { "\x1b[2J\x1b[3J\x1b[H" } else { "" };
    print!("{clear}{text}");
}

/// Checks once and prints, or again and again whenever a file is saved.
///
/// # Errors
/// The reason if no function can be checked; with `--exit-code` also if one does not pass.
pub fn run(options: &Options) -> Result<(), CheckError> {
    let sandbox = sandbox(options)?;
    if options.watch {
        return watch(&sandbox, options);
    }
    let reports = check_in(&sandbox, &options.folder, options.only.as_deref())?;
    show(options, &reports, None);
    let is_open = |report: &&Report| report.status != Status::Passed && report.role != Role::Later;
    let open = reports.iter().filter(is_open).count();
    if options.exit_code && open > 0 { Err(CheckError::Open(open)) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_no_function_has_is_answered_with_those_that_contain_it() {
        let told = |name: &str| CheckError::Unknown(name.to_owned()).to_string();
        assert!(told("newton").ends_with("do you mean newtons_method?"), "{}", told("newton"));
        assert!(told("src/PSI_neo_hookean.rs").contains("do you mean psi_neo_hookean or dpsi"), "{}", told("psi"));
        assert!(told("euler_explicit").ends_with("the README lists the names"));
    }
}
