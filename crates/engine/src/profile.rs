//! How often each part of a body is used, and for how long. A part that a scene leaves out has a meter that never turns.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// Counts the uses of a part, and adds up their time.
#[derive(Debug, Default)]
pub struct Timer {
    uses: AtomicUsize,
    nanoseconds: AtomicU64,
}

impl Timer {
    /// Does a piece of work, and counts it.
    pub fn time<R>(&self, work: impl FnOnce() -> R) -> R {
        let start = Instant::now();
        let result = work();
        self.add(start.elapsed());
        result
    }

    /// Counts a piece of work that has been done.
    pub fn add(&self, duration: Duration) {
        self.uses.fetch_add(1, Relaxed);
        self.nanoseconds.fetch_add(duration.as_nanos() as u64, Relaxed);
    }

    /// Number of uses, and wall-clock time of all of them together, s.
    pub fn read(&self) -> (usize, f64) {
        (self.uses.load(Relaxed), 1e-9 * self.nanoseconds.load(Relaxed) as f64)
    }
}

/// The meters of a body's parts. Their times do not overlap.
#[derive(Debug, Default)]
#[allow(missing_docs)] // the names are those of the parts
pub struct Work {
    pub forces: Timer,
    /// Energies, each with the forces of the same state.
    pub energies: Timer,
    /// Element stiffnesses as they are.
    pub stiffness: Timer,
    /// Element stiffnesses with their projection.
    pub projection: Timer,
    pub mass: Timer,
    pub dead_load: Timer,
    pub prescribed: Timer,
    pub springs: Timer,
    pub pressure: Timer,
    pub damping: Timer,
    pub drag: Timer,
}
