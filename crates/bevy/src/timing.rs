//! Time that the plugin takes in a frame.

use std::time::{Duration, Instant};

use bevy::ecs::resource::Resource;

/// Wall-clock time that the plugin's systems took on Bevy's threads. Steps run elsewhere and are not part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Resource)]
pub struct SoftBodyTiming {
    /// In the last frame.
    pub last: Duration,
    /// In the slowest frame since the start, or since this was set to zero.
    pub longest: Duration,
}

impl SoftBodyTiming {
    /// Begins a frame.
    pub(crate) fn begin_frame(&mut self) {
        self.last = Duration::ZERO;
    }

    /// Adds the time until the returned value is dropped.
    pub(crate) fn watch(&mut self) -> Watch<'_> {
        Watch { timing: self, start: Instant::now() }
    }
}

/// Adds the time of its life to a timing.
pub(crate) struct Watch<'a> {
    timing: &'a mut SoftBodyTiming,
    start: Instant,
}

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        self.timing.last += self.start.elapsed();
        self.timing.longest = self.timing.longest.max(self.timing.last);
    }
}
