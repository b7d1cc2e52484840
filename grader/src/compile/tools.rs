//! The grader's own compilers: cargo and rustc, for sources that are not a submission's.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::process::Command;
use std::time::Duration;
use std::{env, io};

use crate::sandbox::{Confined, Limits, Profile, Sandbox};

/// Longest time for a program of the grader's own, which ends by itself.
const LONGEST: Duration = Duration::from_secs(24 * 3600);

/// Exit code and errors of one of the grader's own programs, with the environment of the grader and the changes of `command`.
///
/// # Errors
/// Those of starting it.
pub fn run(command: &Command, tools: &Sandbox) -> io::Result<(Option<i32>, String)> {
    let text = |word: &OsStr| word.to_string_lossy().into_owned();
    let mut environment: BTreeMap<OsString, OsString> = env::vars_os().collect();
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => environment.insert(name.to_owned(), value.to_owned()),
            None => environment.remove(name),
        };
    }
    let confined = Confined {
        program: command.get_program().into(),
        arguments: command.get_args().map(text).collect(),
        environment: environment.iter().map(|(name, value)| (text(name), text(value))).collect(),
        folder: command.get_current_dir().map_or_else(env::current_dir, |folder| Ok(folder.to_owned()))?,
        readable: Vec::new(),
        writable: Vec::new(),
        profile: Profile::Compiler,
        limits: Limits {
            wall: LONGEST,
            cpu: LONGEST,
            memory: u64::MAX,
            processes: u64::MAX,
            file_size: u64::MAX,
            open_files: u64::MAX,
            output: 1 << 20,
        },
    };
    // If the launcher does not work on a machine, the tools run without it.
    let ended = tools.run(&confined).or_else(|_| Sandbox::none().run(&confined))?;
    Ok((ended.code, String::from_utf8_lossy(&ended.stderr).into_owned()))
}
