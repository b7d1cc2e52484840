//! Timers that count the uses of a part of a simulation.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// Number of uses of a part, and the sum of their wall-clock times. Threads may share it.
#[derive(Debug, Default)]
pub struct Timer {
    uses: AtomicUsize,
    nanoseconds: AtomicU64,
}

impl Timer {
    /// Runs a piece of work and adds its time.
    pub fn time<R>(&self, work: impl FnOnce() -> R) -> R {
        let start = Instant::now();
        let result = work();
        self.add(start.elapsed());
        result
    }

    /// Adds a use that has taken this time.
    pub fn add(&self, duration: Duration) {
        self.uses.fetch_add(1, Relaxed);
        self.nanoseconds.fetch_add(duration.as_nanos() as u64, Relaxed);
    }

    /// Number of uses, and their time, s.
    pub fn read(&self) -> (usize, f64) {
        (self.uses.load(Relaxed), 1e-9 * self.nanoseconds.load(Relaxed) as f64)
    }
}
