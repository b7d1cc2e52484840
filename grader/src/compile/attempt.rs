//! One call of rustc.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::time::Instant;
use std::{env, fs, io};

use super::diagnostics::faults;
use super::prebuilt::Prebuilt;
use super::{Plan, read, sources};
use crate::implementation::budget::Budget;
use crate::sandbox::{Confined, Limits, Profile, Sandbox};

/// Limit of rustc's wall-clock time, in limits of its processor time. The factor allows for a busy machine.
const PATIENCE: u32 = 6;

/// Part of the limit after which a killed compiler counts as timed out. It is less than 1 because the kernel counts processor time in
/// two ways, which differ on a busy machine.
const ALMOST: f64 = 0.7;

/// File in which rustc lists the files that it has read.
const LIST: &str = "program.d";

/// Result of one call of rustc.
pub enum Attempt {
    /// A program.
    Built(PathBuf),
    /// Messages for the authors of the functions with errors; empty if the compiler names no file.
    Failed(BTreeMap<&'static str, String>),
    /// The file reads others while it is compiled; the description of these.
    Refused(String),
    /// The compiler itself crashed; the description of its end.
    GaveUp(String),
    /// The submission has no time left, so the compiler was not started.
    OutOfTime,
}

/// Calls rustc once, for all files of a plan.
///
/// # Errors
/// The reason if files cannot be written or rustc cannot be started.
pub fn attempt(
    prebuilt: &Prebuilt,
    sandbox: &Sandbox,
    plan: &Plan,
    folder: &Path,
    budget: &Budget,
) -> io::Result<Attempt> {
    let limit = plan.limit.min(budget.left_in_all());
    if limit.is_zero() {
        return Ok(Attempt::OutOfTime);
    }
    sources::write(plan, &folder.join("src"))?;
    let file = format!("program{}", env::consts::EXE_SUFFIX);
    let program = folder.join(&file);
    let list = folder.join(LIST);
    for left in [&program, &list].into_iter().filter(|path| path.exists()) {
        fs::remove_file(left)?;
    }
    let mut arguments = prebuilt.arguments();
    let emitted = format!("--emit=link={file},dep-info={LIST}");
    // With its lines a program tells which of them has called a library that panics.
    let lines = "-Cdebuginfo=line-tables-only";
    // As in a student's own build, where a difference of indices below zero panics.
    let overflow = "-Coverflow-checks=on";
    arguments.extend(
        ["--crate-name=submission", "--crate-type=bin", lines, overflow, &emitted, "src/main.rs"].map(str::to_owned),
    );
    let mut readable = prebuilt.readable();
    if let Some((library, _)) = &plan.reference {
        arguments.extend(["--extern".to_owned(), format!("course_below={}", library.display())]);
        readable.extend(library.parent().map(Path::to_owned));
    }
    let begin = Instant::now();
    let ended = sandbox.run(&Confined {
        program: prebuilt.rustc.clone(),
        arguments,
        environment: vec![
            ("PATH".to_owned(), "/usr/bin:/bin".to_owned()),
            ("TMPDIR".to_owned(), folder.display().to_string()),
            // The compiler finds its own library by /proc, which the sandbox does not have.
            ("LD_LIBRARY_PATH".to_owned(), prebuilt.sysroot.join("lib").display().to_string()),
        ],
        folder: folder.to_owned(),
        readable,
        writable: vec![folder.to_owned()],
        profile: Profile::Compiler,
        limits: Limits {
            wall: limit * PATIENCE,
            cpu: limit,
            memory: 4 << 30,
            processes: 64,
            file_size: 256 << 20,
            open_files: 256,
            output: 4 << 20,
        },
    })?;
    let used = Duration::try_from_secs_f64(ended.seconds).unwrap_or_default();
    budget.spend_apart(used.max(begin.elapsed() / PATIENCE));
    Ok(if ended.code == Some(0) && program.exists() {
        // Without this list, the files that the compiler has read are not known.
        match fs::read_to_string(&list).map_or(Some("unknown files".to_owned()), |list| read::first_stray(&list)) {
            None => Attempt::Built(program),
            Some(what) => Attempt::Refused(what),
        }
    } else if ended.timed_out || (ended.signal.is_some() && ended.seconds >= ALMOST * limit.as_secs_f64()) {
        Attempt::GaveUp(format!("the compiler did not finish within {:.0} s", limit.as_secs_f64()))
    } else if ended.signal.is_none() && ended.stderr.starts_with(b"{") {
        let mut found = faults(&String::from_utf8_lossy(&ended.stderr));
        found.retain(|name, _| plan.own.contains_key(name));
        Attempt::Failed(found)
    } else {
        let how = match ended.signal {
            _ if ended.out_of_memory => "no memory left".to_owned(),
            Some(signal) => format!("signal {signal}"),
            None => format!("exit code {:?}", ended.code),
        };
        let most = limit.as_secs_f64();
        Attempt::GaveUp(format!("the compiler ended with {how}; it may compute for {most:.0} s and take 4 GiB"))
    })
}
