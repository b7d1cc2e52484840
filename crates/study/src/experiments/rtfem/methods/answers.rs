//! Evaluation of the runs: errors within a budget of time, times to an error, and whether Newton's method is the fastest.

use super::case::Case;
use super::contenders::{ALL, Contender};
use super::runs::Run;

/// Times of a step, ms.
pub const BUDGETS: [f64; 3] = [1.0, 4.0, 16.0];

/// Solver errors.
pub const ERRORS: [f64; 3] = [1e-2, 1e-3, 1e-6];

/// Young's modulus from which on Newton's method should be the first at [`FIRST_AT`], Pa.
pub const STIFF: f64 = 1e5;

/// The solver error of that claim.
pub const FIRST_AT: f64 = 1e-3;

/// The runs of a method on a case.
pub struct Swept {
    pub contender: &'static Contender,
    pub runs: Vec<Run>,
}

/// A case with the errors that no method can avoid, and the runs of all methods.
pub struct Compared {
    pub case: Case,
    /// Of implicit Euler at this time step, and of springs.
    pub time_error: f64,
    pub model_error: f64,
    pub methods: Vec<Swept>,
}

impl Swept {
    /// The smallest total error of runs whose steps take at most this long (ms), with the solver error of the same run.
    pub fn within(&self, milliseconds: f64) -> Option<&Run> {
        let done = self.runs.iter().filter(|run| run.is_done() && run.milliseconds <= milliseconds);
        let error = |run: &Run| run.solver_error.or(run.total_error).unwrap_or(f64::INFINITY);
        done.min_by(|a, b| error(a).total_cmp(&error(b)))
    }

    /// Time of a step, ms, with which the solver error falls to this; `None` if no run reaches it. Between two runs of an iterated method
    /// error and time follow a power law; the runs of Newton's are taken as they are.
    pub fn time_to(&self, error: f64) -> Option<f64> {
        let points: Vec<(f64, f64)> =
            self.runs.iter().filter_map(|run| Some((run.milliseconds, run.solver_error?))).collect();
        let first = points.iter().position(|point| point.1 <= error)?;
        let (time, reached) = points[first];
        match first.checked_sub(1).map(|before| points[before]) {
            Some((earlier, larger)) if self.contender.is_iterated() && reached > 0.0 && earlier < time => {
                let part = (larger / error).ln() / (larger / reached).ln();
                Some(earlier * (time / earlier).powf(part))
            }
            _ => Some(time),
        }
    }
}

impl Compared {
    /// Iterated methods that reach [`FIRST_AT`] before Newton's: their names, and their time over its.
    pub fn before_newton(&self) -> Vec<(&'static str, f64)> {
        let newton = self.methods.iter().find(|swept| swept.contender.name == ALL[0].name);
        let Some(time) = newton.and_then(|newton| newton.time_to(FIRST_AT)) else { return Vec::new() };
        let others = self.methods.iter().filter(|swept| swept.contender.is_iterated());
        others
            .filter_map(|swept| Some((swept.contender.name, swept.time_to(FIRST_AT)? / time)))
            .filter(|(_, part)| *part < 1.0)
            .collect()
    }

    /// Returns true if Newton's method reaches [`FIRST_AT`].
    pub fn newton_arrives(&self) -> bool {
        self.methods.iter().any(|swept| swept.contender.name == ALL[0].name && swept.time_to(FIRST_AT).is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swept(name: &str, points: &[(f64, f64)]) -> Swept {
        let run = |&(milliseconds, error): &(f64, f64)| Run {
            iterations: Some(1.0),
            value: None,
            milliseconds,
            solver_error: Some(error),
            total_error: Some(error),
            inverted: 0,
            outcome: "done".to_owned(),
        };
        let contender = ALL.iter().find(|contender| contender.name == name).unwrap();
        Swept { contender, runs: points.iter().map(run).collect() }
    }

    #[test]
    fn the_time_to_an_error_lies_between_two_runs_of_an_iterated_method_and_at_one_of_newtons() {
        let points = [(1.0, 1e-1), (4.0, 1e-3), (8.0, 1e-5)];
        assert!((swept("VBD", &points).time_to(1e-2).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(swept("Newton", &points).time_to(1e-2), Some(4.0));
        assert_eq!(swept("VBD", &points).time_to(1e-6), None);
    }

    #[test]
    fn a_budget_allows_runs_that_take_no_longer() {
        let found = swept("VBD", &[(1.0, 1e-1), (4.0, 1e-3), (8.0, 1e-5)]);
        assert_eq!(found.within(5.0).unwrap().milliseconds, 4.0);
        assert!(found.within(0.5).is_none());
    }
}
