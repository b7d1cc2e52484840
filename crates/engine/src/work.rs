//! How often each part of a body is used, and for how long. A part that a scene leaves out has a meter that never turns.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// Counts the uses of a part, and adds up their time.
#[derive(Debug, Default)]
pub struct Meter {
    uses: AtomicUsize,
    nanoseconds: AtomicU64,
}

impl Meter {
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
    pub forces: Meter,
    /// Energies, each with the forces of the same state.
    pub energies: Meter,
    /// Element stiffnesses as they are.
    pub stiffness: Meter,
    /// Element stiffnesses with their projection.
    pub projection: Meter,
    pub mass: Meter,
    pub dead_load: Meter,
    pub prescribed: Meter,
    pub springs: Meter,
    pub pressure: Meter,
    pub damping: Meter,
    pub drag: Meter,
}
