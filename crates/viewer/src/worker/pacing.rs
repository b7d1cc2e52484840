//! Pacing of steps to real time. Times are in seconds; the caller reads the clocks.

use std::collections::VecDeque;

const LARGEST_LAG: f64 = 0.05; // s, largest lag behind the wall clock that is caught up
const RATE_WINDOW: f64 = 1.0; // s of wall clock over which the rate is measured

/// Keeps simulated time from running faster than the wall clock.
#[derive(Clone, Debug, Default)]
pub struct Pace {
    /// A wall-clock time and the simulated time that corresponds to it.
    anchor: Option<(f64, f64)>,
}

impl Pace {
    /// Restarts with the next wait: after a pause, a reset or a failure.
    pub fn restart(&mut self) {
        self.anchor = None;
    }

    /// Time to wait before the next step, s. A larger lag than `LARGEST_LAG` is not caught up: a simulation slower than
    /// real time would otherwise never wait again.
    pub fn wait(&mut self, wall: f64, simulated: f64) -> f64 {
        let (wall_then, simulated_then) = *self.anchor.get_or_insert((wall, simulated));
        let ahead = (simulated - simulated_then) - (wall - wall_then);
        if ahead < -LARGEST_LAG {
            self.anchor = Some((wall, simulated));
        }
        ahead.max(0.0)
    }
}

/// Simulated seconds per second of wall clock, over the last second.
#[derive(Clone, Debug, Default)]
pub struct Rate {
    marks: VecDeque<(f64, f64)>,
}

impl Rate {
    /// Removes the measurements.
    pub fn restart(&mut self) {
        self.marks.clear();
    }

    /// Records that simulated time `simulated` was reached at `wall`.
    pub fn mark(&mut self, wall: f64, simulated: f64) {
        self.marks.push_back((wall, simulated));
        while self.marks.len() > 2 && wall - self.marks[1].0 > RATE_WINDOW {
            self.marks.pop_front();
        }
    }

    /// The rate; `None` until there are enough measurements.
    pub fn factor(&self) -> Option<f64> {
        let (first, last) = (self.marks.front()?, self.marks.back()?);
        let elapsed = last.0 - first.0;
        (elapsed > 0.2 * RATE_WINDOW || self.marks.len() > 2 && elapsed > 0.0).then(|| (last.1 - first.1) / elapsed)
    }
}

/// Describes a rate relative to real time.
pub fn describe(factor: f64) -> String {
    if factor >= 0.97 { "keeps real time".into() } else { format!("{:.1} times slower than real time", 1.0 / factor) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fast_simulation_waits_for_the_clock() {
        let mut pace = Pace::default();
        assert_eq!(pace.wait(100.0, 0.0), 0.0);
        assert!((pace.wait(100.002, 0.01) - 0.008).abs() < 1e-9);
    }

    #[test]
    fn a_short_delay_is_caught_up() {
        let mut pace = Pace::default();
        pace.wait(0.0, 0.0);
        assert_eq!(pace.wait(0.04, 0.01), 0.0);
        assert!((pace.wait(0.041, 0.05) - 0.009).abs() < 1e-9);
    }

    #[test]
    fn a_long_delay_is_not_caught_up() {
        let mut pace = Pace::default();
        pace.wait(0.0, 0.0);
        assert_eq!(pace.wait(10.0, 0.01), 0.0);
        assert!((pace.wait(10.0, 0.02) - 0.01).abs() < 1e-9, "the next step waits as if there had been no delay");
    }

    #[test]
    fn the_rate_is_that_of_the_last_second() {
        let mut rate = Rate::default();
        assert_eq!(rate.factor(), None);
        for i in 0..=10 {
            rate.mark(f64::from(i), 0.0); // ten seconds at a standstill
        }
        for i in 1..=40 {
            rate.mark(10.0 + 0.1 * f64::from(i), 0.05 * f64::from(i));
        }
        assert!((rate.factor().unwrap() - 0.5).abs() < 1e-9);
    }

    #[test]
    fn the_description_says_how_many_times_slower() {
        assert_eq!(describe(1.0), "keeps real time");
        assert_eq!(describe(0.25), "4.0 times slower than real time");
    }
}
