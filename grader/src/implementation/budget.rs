//! The time that a submission may take: for a check, for a function, and as a whole.

use std::cell::Cell;
use std::time::Duration;

/// Clocks of a submission. Waiting for its processes counts, and so does processor time that exceeds the waiting, as several threads use.
#[derive(Debug)]
pub struct Budget {
    check: Clock,
    function: Clock,
    submission: Clock,
}

#[derive(Debug)]
struct Clock {
    allowed: Duration,
    spent: Cell<Duration>,
}

impl Clock {
    fn new(allowed: Duration) -> Self {
        Self { allowed, spent: Cell::new(Duration::ZERO) }
    }

    fn left(&self) -> Duration {
        self.allowed.saturating_sub(self.spent.get())
    }

    fn spend(&self, time: Duration) {
        self.spent.set(self.spent.get().saturating_add(time));
    }
}

impl Budget {
    /// A budget with these times for a check, a function and the submission.
    pub fn new(check: Duration, function: Duration, submission: Duration) -> Self {
        Self { check: Clock::new(check), function: Clock::new(function), submission: Clock::new(submission) }
    }

    /// A budget without limits, for trusted code.
    pub fn unlimited() -> Self {
        Self::new(Duration::MAX, Duration::MAX, Duration::MAX)
    }

    /// Starts the clocks of the next function and of its first check.
    pub fn next_function(&self) {
        self.function.spent.set(Duration::ZERO);
        self.next_check();
    }

    /// Starts the clock of the next check.
    pub fn next_check(&self) {
        self.check.spent.set(Duration::ZERO);
    }

    /// Subtracts time from all clocks.
    pub fn spend(&self, time: Duration) {
        self.check.spend(time);
        self.function.spend(time);
        self.submission.spend(time);
    }

    /// Subtracts time, such as that of the compiler, from the clock of the submission alone.
    pub fn spend_apart(&self, time: Duration) {
        self.submission.spend(time);
    }

    /// The time that the submission as a whole has left.
    pub fn left_in_all(&self) -> Duration {
        self.submission.left()
    }

    /// The shortest remaining time of the clocks.
    pub fn left(&self) -> Duration {
        self.check.left().min(self.function.left()).min(self.submission.left())
    }

    /// The time that was allowed on the clock that has run out, of several the widest.
    pub fn over(&self) -> Option<Duration> {
        [&self.submission, &self.function, &self.check]
            .into_iter()
            .find(|clock| clock.left().is_zero())
            .map(|c| c.allowed)
    }

    /// Returns true if the submission as a whole has no time left.
    pub fn is_used_up(&self) -> bool {
        self.left_in_all().is_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_check_and_a_new_function_begin_anew_and_the_submission_does_not() {
        let seconds = Duration::from_secs;
        let budget = Budget::new(seconds(2), seconds(5), seconds(8));
        budget.spend(seconds(2));
        assert_eq!((budget.left(), budget.over()), (Duration::ZERO, Some(seconds(2))));
        budget.next_check();
        assert_eq!((budget.left(), budget.over()), (seconds(2), None));
        budget.spend(seconds(3));
        budget.next_check();
        assert_eq!(budget.over(), Some(seconds(5)));
        budget.next_function();
        assert_eq!((budget.left(), budget.over()), (seconds(2), None));
        budget.spend(seconds(9));
        budget.next_function();
        assert_eq!((budget.over(), budget.is_used_up()), (Some(seconds(8)), true));
        assert!(!Budget::unlimited().is_used_up());
    }
}
