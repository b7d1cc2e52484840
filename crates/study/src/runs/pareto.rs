//! The Pareto front of error and run time, with the spread of the times.

/// Error and time of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contender {
    /// The error.
    pub error: f64,
    /// Lower and upper quartile of its time, s.
    pub time: (f64, f64),
}

/// The standing of a run among all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Every run that is as exact is slower, beyond the spread of both.
    Front,
    /// No run that is as exact is faster beyond the spread, but one is as fast within it.
    Tie,
    /// A run that is as exact is faster, beyond the spread of both.
    Dominated,
}

impl Standing {
    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Tie => "tie",
            Self::Dominated => "dominated",
        }
    }
}

/// Errors that differ by less than this factor count as equal.
pub const AS_EXACT: f64 = 1.02;

/// The standing of each. Errors and times must be finite.
pub fn standings(runs: &[Contender]) -> Vec<Standing> {
    let of = |(i, run): (usize, &Contender)| {
        let rivals = runs.iter().enumerate().filter(|(j, rival)| *j != i && rival.error <= AS_EXACT * run.error);
        let rivals: Vec<_> = rivals.map(|(_, rival)| rival).collect();
        if rivals.iter().any(|rival| rival.time.1 < run.time.0) {
            Standing::Dominated
        } else if rivals.iter().all(|rival| rival.time.0 > run.time.1) {
            Standing::Front
        } else {
            Standing::Tie
        }
    };
    runs.iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(error: f64, low: f64, high: f64) -> Contender {
        Contender { error, time: (low, high) }
    }

    #[test]
    fn a_faster_and_more_exact_run_dominates() {
        let runs = [run(1e-2, 1.0, 1.1), run(1e-3, 0.8, 0.9), run(1e-4, 2.0, 2.1)];
        assert_eq!(standings(&runs), [Standing::Dominated, Standing::Front, Standing::Front]);
    }

    #[test]
    fn runs_within_the_spread_tie() {
        let runs = [run(1e-2, 1.0, 1.2), run(1e-2, 1.1, 1.3)];
        assert_eq!(standings(&runs), [Standing::Tie, Standing::Tie]);
    }

    #[test]
    fn errors_that_differ_by_one_percent_are_equal() {
        let runs = [run(1.0e-3, 1.0, 1.1), run(1.01e-3, 0.5, 0.6)];
        assert_eq!(standings(&runs), [Standing::Dominated, Standing::Front]);
    }

    #[test]
    fn a_less_exact_run_never_dominates() {
        let runs = [run(1e-3, 1.0, 1.1), run(1e-2, 0.1, 0.2)];
        assert_eq!(standings(&runs), [Standing::Front, Standing::Front]);
    }
}
