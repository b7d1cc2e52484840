//! Checks of an instructor, as Rust files beside the rubric: `[[check]]` names them. The grader builds itself again with them and continues
//! as that program. They run where its own checks run, in the process that is never linked with a submission.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

use grader::compile::prebuilt::{PrebuildError, once};
use grader::compile::tools::run;
use grader::properties::Check;
use grader::sandbox::Sandbox;
use sha2::{Digest, Sha256};
use thiserror::Error;

use crate::rubric::Rubric;

mod built_in {
    use grader::properties::Check;

    include!(concat!(env!("OUT_DIR"), "/own_checks.rs"));
}

/// Reasons for which the checks cannot be used.
#[derive(Debug, Error)]
pub enum OwnChecksError {
    #[error(transparent)]
    Prebuild(#[from] PrebuildError),
    #[error("{}: {error}; the checks of a rubric need a folder to be built in", .path.display())]
    Io { path: PathBuf, error: io::Error },
    #[error("the checks of the rubric do not compile; mend the files that are named here:\n{0}")]
    Build(String),
}

fn at(path: &Path) -> impl FnOnce(io::Error) -> OwnChecksError {
    move |error| OwnChecksError::Io { path: path.to_owned(), error }
}

/// The rubric's own checks of a function.
pub fn of<'a>(function: &'a str, rubric: &'a Rubric) -> impl Iterator<Item = &'static Check> + 'a {
    let is_wanted =
        move |name: &str| rubric.checks.iter().any(|check| check.function.get_ref() == function && check.name == name);
    let own = built_in::OWN.iter().filter(move |(of, check)| *of == function && is_wanted(check.name));
    own.map(|(_, check)| check)
}

/// Returns if this program has the checks of the rubric. If not, the program is built with them and takes the place of this one.
///
/// # Errors
/// The compiler's message, with the file and the line.
pub fn have(rubric: &Rubric, root: &Path, tools: &Sandbox) -> Result<(), OwnChecksError> {
    if rubric.checks.is_empty() {
        return Ok(());
    }
    let rows: Vec<String> = rubric.checks.iter().map(row).collect();
    let list = rows.concat();
    let key = key(&list, rubric, root)?;
    if key == built_in::KEY {
        return Ok(());
    }
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from).join("grader");
    let folder = target.join(format!("own-{key}"));
    let program = folder.join(format!("grader{}", env::consts::EXE_SUFFIX));
    eprintln!("building the grader with {} own checks; the first time takes some minutes", rubric.checks.len());
    once(&folder, || {
        let file = folder.join("checks.txt");
        fs::write(&file, &list).map_err(at(&file))?;
        build((root, tools), &target.join("own"), &file, &key, &program)
    })?;
    run_instead(&program)
}

fn row(check: &crate::rubric::OwnCheck) -> String {
    format!("{}\t{}\t{}\n", check.function.get_ref(), check.name, check.file.display())
}

/// A hash of the list, of the files, and of the sources of the grader that they are built with.
fn key(list: &str, rubric: &Rubric, root: &Path) -> Result<String, OwnChecksError> {
    let mut hash = Sha256::new_with_prefix(list);
    hash.update(built_in::IS_RELEASE.to_string());
    for check in &rubric.checks {
        hash.update(fs::read(&check.file).map_err(at(&check.file))?);
    }
    add_folder(&mut hash, &root.join("grader/src"))?;
    add_folder(&mut hash, &root.join("src"))?;
    Ok(hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect())
}

fn add_folder(hash: &mut Sha256, folder: &Path) -> Result<(), OwnChecksError> {
    let entries = fs::read_dir(folder).and_then(|entries| entries.map(|entry| Ok(entry?.path())).collect());
    let mut entries: Vec<PathBuf> = entries.map_err(at(folder))?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            add_folder(hash, &path)?;
        } else {
            hash.update(fs::read(&path).map_err(at(&path))?);
        }
    }
    Ok(())
}

fn build(
    (root, tools): (&Path, &Sandbox),
    target: &Path,
    list: &Path,
    key: &str,
    program: &Path,
) -> Result<(), OwnChecksError> {
    let cargo = |more: &[&str]| {
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.current_dir(root).args(["build", "--quiet", "-p", "grader", "--bin", "grader"]).args(more);
        cargo.arg("--target-dir").arg(target).env("GRADER_CHECKS", list).env("GRADER_CHECKS_KEY", key);
        run(&cargo, tools).map_err(at(Path::new("cargo")))
    };
    let (profile, folder): (&[&str], _) =
        if built_in::IS_RELEASE { (&["--release"], "release") } else { (&[], "debug") };
    let (mut code, mut told) = cargo(&[profile, &["--offline"]].concat())?;
    if code != Some(0) && told.contains("--offline") {
        (code, told) = cargo(profile)?;
    }
    if code != Some(0) {
        return Err(OwnChecksError::Build(told));
    }
    let built = target.join(folder).join(program.file_name().unwrap_or_default());
    fs::copy(&built, program).map(drop).map_err(at(&built))
}

/// Replaces this process by another program with the same arguments.
fn run_instead(program: &Path) -> Result<(), OwnChecksError> {
    let mut command = Command::new(program);
    command.args(env::args_os().skip(1));
    #[cfg(unix)]
    return Err(at(program)(std::os::unix::process::CommandExt::exec(&mut command)));
    #[cfg(not(unix))]
    {
        let status = command.status().map_err(at(program))?;
        std::process::exit(status.code().unwrap_or(1))
    }
}
