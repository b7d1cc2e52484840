//! The processor time of a grading with all its processes.

use std::time::Instant;

/// Processor time since its start.
pub struct CpuTimer {
    begin: Instant,
    used_before: Option<f64>,
}

impl CpuTimer {
    /// Starts the timer.
    pub fn start() -> Self {
        Self { begin: Instant::now(), used_before: cpu_seconds() }
    }

    /// Processor time since the start, of this process and of those that it has started and that have ended, s. On a system
    /// without that counter, the wall-clock time.
    pub fn seconds(&self) -> f64 {
        match (self.used_before, cpu_seconds()) {
            (Some(before), Some(now)) => now - before,
            _ => self.begin.elapsed().as_secs_f64(),
        }
    }
}

#[cfg(target_os = "linux")]
fn cpu_seconds() -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    let of = |who| {
        let usage = getrusage(who).ok()?;
        let seconds = [usage.user_time(), usage.system_time()].map(|t| t.tv_sec() as f64 + t.tv_usec() as f64 * 1e-6);
        Some(seconds.iter().sum::<f64>())
    };
    Some(of(UsageWho::RUSAGE_SELF)? + of(UsageWho::RUSAGE_CHILDREN)?)
}

#[cfg(not(target_os = "linux"))]
fn cpu_seconds() -> Option<f64> {
    None
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::CpuTimer;
    use std::process::Command;

    #[test]
    fn the_processor_time_of_another_process_counts() {
        let timer = CpuTimer::start();
        let work = "i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done";
        assert!(Command::new("sh").args(["-c", work]).status().unwrap().success());
        assert!(timer.seconds() > 0.02, "{} s of work", timer.seconds());
    }
}
