//! The clock of a body: steps that are due, and the time that is shown.

/// Time of a body since it has appeared, in steps of fixed length.
///
/// Steps are requested one ahead of the clock, so that the worker has a whole step, or a whole frame, of time for each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Time step, s.
    dt: f64,
    /// Time that has passed, less the dropped time, s.
    now: f64,
    /// Time that is shown, s.
    shown: f64,
    /// Time by which it lies back, s: the time step, or the longest of the last frames.
    delay: f64,
    /// Time that was left out because steps took too long, s.
    dropped: f64,
}

/// Part of the time by which a picture moves faster than the clock while it catches up after a long frame.
const CATCHING_UP: f64 = 0.1;

impl Clock {
    /// A clock at time zero for steps of `dt`, s.
    pub fn new(dt: f64) -> Self {
        Self { dt, ..Self::default() }
    }

    /// Advances by a frame of `seconds`, and returns the number of steps that are to be done in all. Of `done` steps so far, at most
    /// `most_ahead` are requested; the time that more of them would take is dropped.
    pub fn advance(&mut self, seconds: f64, done: usize, most_ahead: usize) -> usize {
        let before = self.now;
        self.now += seconds;
        let most = done + most_ahead;
        let excess = self.due().saturating_sub(most);
        if excess > 0 {
            let kept = (self.now - excess as f64 * self.dt).max(before);
            self.dropped += self.now - kept;
            self.now = kept;
        }
        // At least a frame, so that what is shown lies between steps that were requested in an earlier frame. After a long frame
        // the delay goes back slowly, so that the motion stays even.
        self.delay = (self.delay - CATCHING_UP * seconds).max(seconds).max(self.dt);
        self.shown = (self.now - self.delay).max(self.shown);
        self.due()
    }

    /// Time step, s.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Time that is shown, in steps.
    pub fn shown_steps(&self) -> f64 {
        self.shown / self.dt
    }

    /// Time that is shown, s.
    pub fn shown(&self) -> f64 {
        self.shown
    }

    /// Time that was left out, s.
    pub fn dropped(&self) -> f64 {
        self.dropped
    }

    fn due(&self) -> usize {
        (self.now / self.dt).floor() as usize + 1
    }
}

#[cfg(test)]
mod tests {
    use super::Clock;

    #[test]
    fn short_frames_are_shown_a_step_ago_with_one_step_requested_ahead() {
        let mut clock = Clock::new(1.0);
        let due: Vec<usize> = (0..8).map(|_| clock.advance(0.5, 10, 100)).collect();
        assert_eq!(due, [1, 2, 2, 3, 3, 4, 4, 5]);
        assert_eq!((clock.shown(), clock.dropped()), (3.0, 0.0));
    }

    #[test]
    fn long_frames_are_shown_a_frame_ago() {
        let mut clock = Clock::new(1.0);
        assert_eq!(clock.advance(3.5, 0, 100), 4);
        assert_eq!(clock.advance(3.5, 4, 100), 8);
        assert_eq!(clock.shown_steps(), 3.5);
    }

    #[test]
    fn what_is_shown_was_requested_in_an_earlier_frame() {
        for frame in [0.3, 0.9, 1.0, 1.7, 6.0] {
            let (mut clock, mut requested) = (Clock::new(1.0), 0);
            for _ in 0..50 {
                let due = clock.advance(frame, requested, 100);
                assert!(clock.shown_steps() <= requested as f64, "frames of {frame} steps");
                requested = due;
            }
        }
    }

    #[test]
    fn frames_of_uneven_lengths_are_shown_evenly() {
        let mut clock = Clock::new(1.0);
        clock.advance(5.0, 10, 100);
        let mut last = clock.shown();
        for frame in [0.5, 1.5].into_iter().cycle().take(100) {
            clock.advance(frame, 100, 100);
            let moved = clock.shown() - last;
            assert!((moved - frame).abs() < 0.11 * frame, "{moved} in a frame of {frame}");
            last = clock.shown();
        }
    }

    #[test]
    fn a_slow_worker_drops_time_and_never_gets_more_than_the_bound() {
        let mut clock = Clock::new(0.5);
        let due: Vec<usize> = (0..6).map(|_| clock.advance(1.0, 0, 4)).collect();
        assert_eq!(due, [3, 4, 4, 4, 4, 4]);
        assert_eq!(clock.dropped(), 4.5);
        assert_eq!(clock.advance(0.5, 4, 4), 5, "it goes on from there");
    }
}
