//! The machine, the build and the date of a measurement.

use std::path::Path;
use std::process::Command;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

/// A machine, the build of the program, and the commit of its sources.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the processor.
    pub cpu: String,
    /// Threads that the engine uses.
    pub threads: usize,
    /// Version of the compiler on this machine; `unknown` without one.
    pub rustc: String,
    /// `release` or `debug`, and the compiler's flags.
    pub flags: String,
    /// Abbreviated commit, marked `-dirty` if files differ from it; `unknown` outside a checkout.
    pub commit: String,
    /// Date, UTC.
    pub date: String,
    /// Load average of the last minute at the start.
    pub load: String,
}

impl Machine {
    /// This machine, now, with the commit of the checkout around a folder.
    pub fn this(folder: &Path) -> Self {
        let unknown = || "unknown".to_owned();
        let profile = env!("PROFILE");
        let flags = option_env!("RUSTFLAGS").filter(|flags| !flags.is_empty()).unwrap_or("no flags");
        Self {
            cpu: cpu().unwrap_or_else(unknown),
            threads: threads(),
            rustc: first_line(Command::new("rustc").arg("--version")).unwrap_or_else(unknown),
            flags: format!("{profile}, {flags}"),
            commit: commit(folder).unwrap_or_else(unknown),
            date: Timestamp::now().strftime("%F").to_string(),
            load: load().unwrap_or_else(unknown),
        }
    }

    /// Returns true if the load exceeds the number of threads, so that wall-clock times are too long.
    pub fn is_busy(&self) -> bool {
        self.load.parse::<f64>().is_ok_and(|load| load > self.threads as f64)
    }

    /// One line for readers.
    pub fn line(&self) -> String {
        let Self { cpu, threads, rustc, flags, commit, date, load } = self;
        format!("{date}; {cpu}, {threads} threads; {rustc}, {flags}; commit {commit}; load {load} at the start")
    }
}

/// Threads of the engine.
pub fn threads() -> usize {
    rayon::current_num_threads()
}

fn cpu() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn load() -> Option<String> {
    let text = std::fs::read_to_string("/proc/loadavg").ok()?;
    text.split(' ').next().map(str::to_owned)
}

fn commit(folder: &Path) -> Option<String> {
    let describe = ["describe", "--always", "--dirty", "--exclude", "*"];
    first_line(Command::new("git").arg("-C").arg(folder).args(describe))
}

/// The first line of a program's output; `None` if the program fails.
fn first_line(command: &mut Command) -> Option<String> {
    let output = command.output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.lines().next()?.to_owned())
}

/// Peak memory of this process since [`reset_peak`], MB; `None` unless on Linux.
pub fn peak_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()? / 1024.0)
}

/// Processor time of all threads of this process, s; `None` unless on Linux.
pub fn processor_seconds() -> Option<f64> {
    let threads = std::fs::read_dir("/proc/self/task").ok()?.flatten();
    // The file of a thread vanishes when the thread ends.
    let texts = threads.filter_map(|thread| std::fs::read_to_string(thread.path().join("schedstat")).ok());
    let nanoseconds: Option<Vec<f64>> = texts.map(|text| text.split(' ').next()?.parse().ok()).collect();
    nanoseconds.filter(|times| !times.is_empty()).map(|times| 1e-9 * times.iter().sum::<f64>())
}

/// Resets the peak memory, if the system permits it. Otherwise [`peak_mb`] is an upper bound.
pub fn reset_peak() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}
