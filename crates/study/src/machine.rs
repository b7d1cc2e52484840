//! What the times were measured on, and when.

use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use serde::Serialize;

/// A machine, how the program was built, and the state of its sources.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// Name of the processor.
    pub cpu: String,
    /// Threads that the engine uses.
    pub threads: usize,
    /// `release` or `debug`, and the compiler's flags.
    pub flags: String,
    /// Short name of the commit, with a mark where files differ from it; `unknown` outside a checkout.
    pub commit: String,
    /// Day, UTC.
    pub date: String,
    /// Processes that wanted to run as the study began, a mean over the last minute.
    pub load: String,
}

impl Machine {
    /// This one, now; the commit is that of the checkout around this folder.
    pub fn this(folder: &Path) -> Self {
        let unknown = || "unknown".to_owned();
        let profile = if cfg!(debug_assertions) { "debug" } else { "release" };
        let flags = option_env!("RUSTFLAGS").filter(|flags| !flags.is_empty()).unwrap_or("no flags");
        Self {
            cpu: cpu().unwrap_or_else(unknown),
            threads: rayon::current_num_threads(),
            flags: format!("{profile}, {flags}"),
            commit: commit(folder).unwrap_or_else(unknown),
            date: date(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())),
            load: load().unwrap_or_else(unknown),
        }
    }

    /// Whether more wanted to run than can: times are longer then than they need to be.
    pub fn is_busy(&self) -> bool {
        self.load.parse::<f64>().is_ok_and(|load| load > self.threads as f64)
    }

    /// One line for people.
    pub fn line(&self) -> String {
        let Self { cpu, threads, flags, commit, date, load } = self;
        format!("{date}; {cpu}, {threads} threads; {flags}; commit {commit}; load {load} as it began")
    }
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
    let git = Command::new("git")
        .arg("-C")
        .arg(folder)
        .args(["describe", "--always", "--dirty", "--exclude", "*"])
        .output()
        .ok()?;
    let text = String::from_utf8(git.stdout).ok().filter(|_| git.status.success())?;
    Some(text.lines().next()?.to_owned())
}

/// Largest memory of this process since [`forget_peak`], MB, where the system tells (Linux).
pub fn peak_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()? / 1024.0)
}

/// Processor time of all threads of this process so far, s, where the system tells (Linux).
pub fn processor_seconds() -> Option<f64> {
    let threads = std::fs::read_dir("/proc/self/task").ok()?.flatten();
    // A thread that has just ended has no file any more.
    let texts = threads.filter_map(|thread| std::fs::read_to_string(thread.path().join("schedstat")).ok());
    let nanoseconds: Option<Vec<f64>> = texts.map(|text| text.split(' ').next()?.parse().ok()).collect();
    nanoseconds.filter(|times| !times.is_empty()).map(|times| 1e-9 * times.iter().sum::<f64>())
}

/// Lets the largest memory be counted anew from now on, where the system allows it; else it goes on counting.
pub fn forget_peak() {
    // Where it is refused, the peak is that of the process so far, which is no less.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// `2026-11-21` of seconds since 1970: H. Hinnant, "chrono-compatible low-level date algorithms", civil_from_days.
fn date(seconds: u64) -> String {
    let days = (seconds / 86_400) as i64 + 719_468;
    let era = days / 146_097;
    let of_era = days - era * 146_097;
    let year = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = year + era * 400 + i64::from(month <= 2);
    format!("{year}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn days_since_1970_become_dates() {
        assert_eq!(date(0), "1970-01-01");
        assert_eq!(date(951_782_400), "2000-02-29");
        assert_eq!(date(1_795_219_200), "2026-11-21");
    }
}
