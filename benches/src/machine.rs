//! What the times were measured on.

use std::fs;
use std::process::Command;

use serde::Serialize;

/// A machine, the compiler and the state of the sources.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    pub processor: String,
    pub threads: usize,
    pub rustc: String,
    pub rustflags: String,
    pub commit: String,
    /// Processes that wanted to run, a mean over the last minute.
    pub load: String,
}

impl Machine {
    /// This one, now. What cannot be found out is `unknown`.
    pub fn this() -> Self {
        Self {
            processor: processor().unwrap_or_else(unknown),
            threads: threads(),
            rustc: first_line("rustc", &["--version"]).unwrap_or_else(unknown),
            rustflags: option_env!("RUSTFLAGS").unwrap_or("none").to_owned(),
            commit: commit().unwrap_or_else(unknown),
            load: load().unwrap_or_else(unknown),
        }
    }

    /// One line for people.
    pub fn line(&self) -> String {
        let Self { processor, threads, rustc, rustflags, commit, load } = self;
        format!("{processor}, {threads} threads; {rustc}, release, flags: {rustflags}; commit {commit}; load {load}")
    }
}

/// Threads that this machine runs at once.
pub fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

fn unknown() -> String {
    "unknown".to_owned()
}

fn processor() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn load() -> Option<String> {
    let text = fs::read_to_string("/proc/loadavg").ok()?;
    text.split(' ').next().map(str::to_owned)
}

/// Short name of the commit, with a mark where files differ from it.
fn commit() -> Option<String> {
    first_line("git", &["describe", "--always", "--dirty", "--exclude", "*"])
}

fn first_line(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.lines().next()?.to_owned())
}
