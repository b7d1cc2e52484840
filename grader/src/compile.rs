//! Compiles the files of a submission into a program that answers calls, with one call of rustc for many functions. A file that does not
//! compile affects its own function only.

mod attempt;
mod diagnostics;
mod locked;
mod paths;
pub mod prebuilt;
mod read;
mod sources;
pub mod tools;

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use thiserror::Error;

use crate::implementation::budget::Budget;
use crate::sandbox::Sandbox;
use crate::status::Status;
use crate::submission::mentions;
pub use attempt::{Attempt, attempt};
use prebuilt::Prebuilt;

/// The parts of a program.
#[derive(Clone)]
pub struct Plan {
    /// Texts of the submission, by function.
    pub own: BTreeMap<&'static str, String>,
    /// A library with right functions for those that are not `own`, and their names.
    pub reference: Option<(PathBuf, BTreeSet<&'static str>)>,
    /// Texts of the submission that are compiled only for their other items: a call of their function goes to the reference.
    pub helpers: BTreeMap<&'static str, String>,
    /// Limit of rustc's processor time for one program.
    pub limit: Duration,
}

/// A program, and the functions that could not become part of it.
pub struct Built {
    /// The program; `None` if the build failed.
    pub program: Option<PathBuf>,
    /// The functions that could not be compiled, and why.
    pub faults: BTreeMap<&'static str, Fault>,
}

/// Reason why a file could not become part of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// It does not compile, is refused, or its time was over.
    pub status: Status,
    /// A message for its author.
    pub message: String,
}

/// Errors of the grader or its machine during a build. They are never a verdict on a file.
#[derive(Debug, Error)]
pub enum BuildError {
    /// Files cannot be written, or rustc cannot be started.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The compiler crashes on files together that it compiles separately.
    #[error(
        "{0}; it took the files apart, so give it more time (compile_seconds in the rubric) or the machine more memory"
    )]
    GaveUp(String),
    /// A program without any file of a submission does not compile.
    #[error("not even a program without a function can be built; do rustc and its linker work on this machine?")]
    Nothing,
}

/// Builds a program in `folder`. Files that do not compile are left out, and their functions panic when they are called.
///
/// # Errors
/// The reason if the machine or the compiler fails.
pub fn build(prebuilt: &Prebuilt, sandbox: &Sandbox, plan: &Plan, folder: &Path) -> Result<Built, BuildError> {
    build_within(prebuilt, sandbox, plan, folder, &Budget::unlimited())
}

/// The same within a budget of time. Files that are not compiled when it is used up are faults.
///
/// # Errors
/// The reason if the machine or the compiler fails.
pub fn build_within(
    prebuilt: &Prebuilt,
    sandbox: &Sandbox,
    plan: &Plan,
    folder: &Path,
    budget: &Budget,
) -> Result<Built, BuildError> {
    let mut plan = plan.clone();
    let mut all_faults = BTreeMap::new();
    loop {
        let (mut found, gave_up) = match attempt(prebuilt, sandbox, &plan, folder, budget)? {
            Attempt::Built(program) => return Ok(Built { program: Some(program), faults: all_faults }),
            Attempt::Failed(faults) => {
                (faults.into_iter().map(|(name, message)| (name, does_not_compile(message))).collect(), None)
            }
            Attempt::Refused(_) => (BTreeMap::new(), None),
            Attempt::GaveUp(why) => (BTreeMap::new(), Some(why)),
            Attempt::OutOfTime => {
                all_faults.extend(plan.own.keys().map(|name| (*name, out_of_time())));
                return Ok(Built { program: None, faults: all_faults });
            }
        };
        if plan.own.is_empty() {
            return Err(BuildError::Nothing);
        }
        if found.is_empty() {
            found = one_by_one(prebuilt, sandbox, &plan, folder, budget)?;
        }
        if found.is_empty() {
            if let Some(why) = gave_up {
                return Err(BuildError::GaveUp(why));
            }
            // The compiler fails although each file compiles alone, so the fault is reported for all of them.
            let sentence = "the files compile one by one, but not together";
            found = plan.own.keys().map(|name| (*name, does_not_compile(sentence.to_owned()))).collect();
        }
        let found = without_consequences(found, &plan);
        plan.own.retain(|name, _| !found.contains_key(name));
        all_faults.extend(found);
    }
}

/// The faults of files that name no other faulty function: the next attempt shows whether the others compile without these, whose wrong
/// signature or missing `pub` is an error in each file that calls them. All faults if each file names another.
fn without_consequences(found: BTreeMap<&'static str, Fault>, plan: &Plan) -> BTreeMap<&'static str, Fault> {
    let names_faulty = |name: &str| {
        let others = plan.own.get(name).map(|text| mentions(text)).unwrap_or_default();
        others.into_iter().any(|other| other != name && found.contains_key(other))
    };
    let first: BTreeSet<&str> = found.keys().copied().filter(|name| !names_faulty(name)).collect();
    if first.is_empty() { found } else { found.into_iter().filter(|(name, _)| first.contains(name)).collect() }
}

/// Finds the files that cannot be compiled even alone.
fn one_by_one(
    prebuilt: &Prebuilt,
    sandbox: &Sandbox,
    plan: &Plan,
    folder: &Path,
    budget: &Budget,
) -> io::Result<BTreeMap<&'static str, Fault>> {
    let mut found = BTreeMap::new();
    for (name, text) in &plan.own {
        let alone = Plan { own: BTreeMap::from([(*name, text.clone())]), ..plan.clone() };
        let fault = match attempt(prebuilt, sandbox, &alone, folder, budget)? {
            Attempt::Built(_) => continue,
            Attempt::Failed(mut faults) => {
                does_not_compile(faults.remove(name).unwrap_or_else(|| "the file does not compile".to_owned()))
            }
            Attempt::Refused(what) => refused(&what),
            Attempt::GaveUp(why) => does_not_compile(why),
            Attempt::OutOfTime => out_of_time(),
        };
        found.insert(*name, fault);
    }
    Ok(found)
}

fn does_not_compile(message: String) -> Fault {
    Fault { status: Status::DidNotCompile, message }
}

fn refused(what: &str) -> Fault {
    let message = format!("the file reads {what} while it is compiled, which is not allowed; do without it");
    Fault { status: Status::Refused, message }
}

fn out_of_time() -> Fault {
    let message = "the time of the submission was used up before this file was compiled".to_owned();
    Fault { status: Status::TimedOut, message }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::fs;
    use std::os::unix::fs::PermissionsExt;

    /// Builds two files with this script, started beside `src`, in place of the compiler.
    fn built_by(script: &str) -> Result<Built, BuildError> {
        let folder = tempfile::tempdir().unwrap();
        let rustc = folder.path().join("rustc");
        fs::write(&rustc, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&rustc, fs::Permissions::from_mode(0o755)).unwrap();
        let place = folder.path().to_owned();
        let prebuilt = Prebuilt {
            folder: place.clone(),
            rustc,
            sysroot: place.clone(),
            toolchain: String::new(),
            tools: Sandbox::none(),
        };
        let own = ["psi_neo_hookean", "newtons_method"].map(|name| (name, String::new())).into();
        let plan = Plan { own, reference: None, helpers: BTreeMap::new(), limit: Duration::from_secs(20) };
        build(&prebuilt, &Sandbox::none(), &plan, &place)
    }

    /// Ends a script here where there are not two files.
    const FEW: &str = "[ $(ls src/calls | wc -l) != 2 ] && touch program program.d && exit 0";

    #[test]
    fn a_compiler_that_breaks_down_over_files_that_it_takes_one_by_one_is_no_fault_of_theirs() {
        let broken = built_by(&format!("{FEW}\nexit 101"));
        assert!(matches!(&broken, Err(BuildError::GaveUp(why)) if why.contains("101")), "{:?}", broken.err());
    }

    #[test]
    fn a_compiler_that_does_not_work_is_no_fault_of_any_file() {
        for script in ["exit 101", "echo '{\"level\":\"error\"}' >&2\nexit 1"] {
            assert!(matches!(built_by(script), Err(BuildError::Nothing)), "{script}");
        }
    }

    #[test]
    fn a_compiler_that_refuses_them_together_or_breaks_down_over_each_blames_them() {
        let together = built_by(&format!("{FEW}\necho '{{\"level\":\"error\"}}' >&2\nexit 1")).unwrap();
        assert_eq!(together.faults.len(), 2);
        assert!(together.faults["newtons_method"].message.contains("not together"));
        let refuses = "[ $(ls src/calls | wc -l) = 0 ] && touch program program.d && exit 0";
        let reads =
            built_by(&format!("{refuses}\ntouch program; echo 'program: src/main.rs /etc/passwd' >program.d")).unwrap();
        assert!(reads.faults.values().all(|fault| fault.status == Status::Refused), "{:?}", reads.faults);
        let silent = built_by(&format!("{refuses}\ntouch program")).unwrap();
        assert_eq!(silent.faults.len(), 2);
        let each = built_by("[ $(ls src/calls | wc -l) = 0 ] && touch program program.d && exit 0\nexit 101").unwrap();
        assert!(each.program.is_some() && each.faults.len() == 2);
    }
}
