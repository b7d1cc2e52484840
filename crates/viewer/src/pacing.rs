//! Keeping step with the clock on the wall. Times are seconds on clocks that the caller reads.

use std::collections::VecDeque;

const FORGIVEN: f64 = 0.05; // s behind the clock that may be caught up; more is given up
const RATE_WINDOW: f64 = 1.0; // s of wall clock over which the rate is measured

/// Lets simulated time run as fast as the clock, and never faster.
#[derive(Clone, Debug, Default)]
pub struct Pace {
    /// Wall clock and simulated time that belong together.
    anchor: Option<(f64, f64)>,
}

impl Pace {
    /// Starts anew with the next wait: after a pause, a reset or a failure.
    pub fn restart(&mut self) {
        self.anchor = None;
    }

    /// How long to wait before the next step, s. Whoever is late goes on at once and does not try to catch up
    /// more than a moment: a simulation that is too slow would otherwise fall behind for ever.
    pub fn wait(&mut self, wall: f64, simulated: f64) -> f64 {
        let (wall_then, simulated_then) = *self.anchor.get_or_insert((wall, simulated));
        let ahead = (simulated - simulated_then) - (wall - wall_then);
        if ahead < -FORGIVEN {
            self.anchor = Some((wall, simulated));
        }
        ahead.max(0.0)
    }
}

/// Simulated seconds per second of wall clock, over the last moments.
#[derive(Clone, Debug, Default)]
pub struct Rate {
    marks: VecDeque<(f64, f64)>,
}

impl Rate {
    /// Forgets what was measured.
    pub fn restart(&mut self) {
        self.marks.clear();
    }

    /// Notes that `simulated` was reached at `wall`.
    pub fn mark(&mut self, wall: f64, simulated: f64) {
        self.marks.push_back((wall, simulated));
        while self.marks.len() > 2 && wall - self.marks[1].0 > RATE_WINDOW {
            self.marks.pop_front();
        }
    }

    /// The rate, once it can be told.
    pub fn factor(&self) -> Option<f64> {
        let (first, last) = (self.marks.front()?, self.marks.back()?);
        let elapsed = last.0 - first.0;
        (elapsed > 0.2 * RATE_WINDOW || self.marks.len() > 2 && elapsed > 0.0).then(|| (last.1 - first.1) / elapsed)
    }
}

/// What a rate means, in words.
pub fn verdict(factor: f64) -> String {
    if factor >= 0.97 { "keeps real time".into() } else { format!("slower than real time: {:.1}×", 1.0 / factor) }
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
        assert!((pace.wait(10.0, 0.02) - 0.01).abs() < 1e-9, "the next step waits as if nothing had been late");
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
    fn the_verdict_says_how_many_times_slower() {
        assert_eq!(verdict(1.0), "keeps real time");
        assert_eq!(verdict(0.25), "slower than real time: 4.0×");
    }
}
