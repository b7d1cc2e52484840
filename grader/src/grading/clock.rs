//! The processor time of a grading with all its processes.

use std::time::Instant;

/// Counts from its start.
pub struct Clock {
    begin: Instant,
    used_before: Option<f64>,
}

impl Clock {
    /// Starts to count.
    pub fn start() -> Self {
        Self { begin: Instant::now(), used_before: used() }
    }

    /// Processor time since the start, of this process and of those that it has started and that have ended, s. On a system
    /// that does not tell, the time that has passed.
    pub fn seconds(&self) -> f64 {
        match (self.used_before, used()) {
            (Some(before), Some(now)) => now - before,
            _ => self.begin.elapsed().as_secs_f64(),
        }
    }
}

#[cfg(target_os = "linux")]
fn used() -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    let of = |who| {
        let usage = getrusage(who).ok()?;
        let seconds = [usage.user_time(), usage.system_time()].map(|t| t.tv_sec() as f64 + t.tv_usec() as f64 * 1e-6);
        Some(seconds.iter().sum::<f64>())
    };
    Some(of(UsageWho::RUSAGE_SELF)? + of(UsageWho::RUSAGE_CHILDREN)?)
}

#[cfg(not(target_os = "linux"))]
fn used() -> Option<f64> {
    None
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::Clock;
    use std::process::Command;

    #[test]
    fn the_work_of_another_process_counts() {
        let clock = Clock::start();
        let work = "i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done";
        assert!(Command::new("sh").args(["-c", work]).status().unwrap().success());
        assert!(clock.seconds() > 0.02, "{} s of work", clock.seconds());
    }
}
