//! The methods that are compared, with the parameters that are swept and tuned; their runs on a case, with more and more iterations until the error
//! is round-off or steps take long; and the evaluation: errors within a budget of time, times to an error, whether Newton's method is the fastest.

use std::time::Instant;

use fem_engine::simulator::Simulator;
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Integrator, IterationSettings, Method};
use nalgebra::DVector;

use super::super::setting::median_and_p95;
use super::case::{Case, LAW, Measures};
use crate::scenes::SPRINGS;
use crate::study::Result;

/// A method.
#[derive(Clone, Copy, Debug)]
pub struct Contender {
    /// The name in tables.
    pub name: &'static str,
    /// The model of the material.
    pub model: &'static str,
    /// The method of its steps.
    pub integrator: Integrator,
    /// Kind of its iterations.
    pub sweep: Sweep,
    /// A setting of the iterations, and the values from which the best is taken for each case.
    pub tuned: Option<(Tune, &'static [f64])>,
    /// XPBD keeps the residual of the equation of motion.
    pub residual: bool,
}

/// Settings of iterations with a value of a tuned one.
type Tune = fn(IterationSettings, f64) -> IterationSettings;

/// The iterations of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sweep {
    /// Newton iterations until the update is below a tolerance.
    Newton,
    /// Sweeps or rounds, a fixed number of them.
    Iterations,
    /// The method has no iterations, or all of them until it converges.
    Whole,
}

const NEWTON: Contender = Contender {
    name: "Newton",
    model: LAW,
    integrator: Integrator::ImplicitEuler,
    sweep: Sweep::Newton,
    tuned: None,
    residual: true,
};
const ITERATED: Contender = Contender { sweep: Sweep::Iterations, ..NEWTON };

/// The two parameters without a rule for their choice, with the values that they are tuned over: as many for each.
const RADII: (Tune, &[f64]) =
    (|settings, radius| IterationSettings { acceleration: Some(radius), ..settings }, &[0.5, 0.8, 0.9, 0.95, 0.98]);
const STIFFNESSES: (Tune, &[f64]) =
    (|settings, stiffness| IterationSettings { stiffness, ..settings }, &[0.01, 0.1, 0.5, 0.9, 1.0]);

/// All methods. Newton's is the first.
pub const ALL: [Contender; 11] = [
    NEWTON,
    Contender {
        name: "linearly implicit",
        integrator: Integrator::LinearlyImplicitEuler,
        sweep: Sweep::Whole,
        ..NEWTON
    },
    Contender { name: "BDF2", integrator: Integrator::Bdf2, sweep: Sweep::Whole, ..NEWTON },
    Contender { name: "XPBD", integrator: Integrator::Xpbd, ..ITERATED },
    Contender { name: "XPBD, no residual", integrator: Integrator::Xpbd, residual: false, ..ITERATED },
    Contender { name: "VBD", integrator: Integrator::Vbd, ..ITERATED },
    Contender { name: "VBD, Chebyshev", integrator: Integrator::Vbd, tuned: Some(RADII), ..ITERATED },
    Contender { name: "PD", integrator: Integrator::ProjectiveDynamics, ..ITERATED },
    Contender { name: "PBD", integrator: Integrator::Pbd, tuned: Some(STIFFNESSES), ..ITERATED },
    Contender { name: "springs, Newton", model: SPRINGS, sweep: Sweep::Whole, ..NEWTON },
    Contender {
        name: "springs, linearly implicit",
        model: SPRINGS,
        integrator: Integrator::LinearlyImplicitEuler,
        sweep: Sweep::Whole,
        ..NEWTON
    },
];

impl Contender {
    /// The method with so many iterations, or, of Newton's method, digits of its tolerance; and a value of the tuned setting.
    pub fn method(&self, dt: f64, iterations: usize, value: Option<f64>) -> Method {
        let mut method = Method::new(self.integrator, dt);
        match self.sweep {
            Sweep::Newton => method.newton.tolerance = Some(10f64.powi(-(iterations as i32))),
            Sweep::Iterations => {
                let settings =
                    IterationSettings { count: iterations, residual: self.residual, ..IterationSettings::default() };
                let tuned = self.tuned.zip(value).map(|((tune, _), value)| tune(settings, value));
                method.iterations = tuned.unwrap_or(settings);
            }
            Sweep::Whole => {}
        }
        method
    }

    /// Returns true if the steps converge to those of implicit Euler for the elements, so that a solver error is defined.
    pub fn has_solver_error(&self) -> bool {
        self.model == LAW && ![Integrator::Bdf2, Integrator::Pbd].contains(&self.integrator)
    }

    /// Returns true if the number of iterations is a parameter of the method.
    pub fn is_iterated(&self) -> bool {
        self.sweep == Sweep::Iterations
    }
}

/// Digits of Newton's tolerance, and iterations of a step, one run for each.
const DIGITS: [usize; 5] = [1, 3, 5, 8, 12];
const COUNTS: [usize; 12] = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

/// Iterations with which the tuned key is tried.
const TUNED_AT: usize = 20;

/// Solver error and time of a step (ms) at which the sweep of a method ends.
const CONVERGED: f64 = 1e-8;

/// Limits of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Longest median step, ms.
    pub milliseconds: f64,
    /// Largest number of iterations.
    pub iterations: usize,
}

/// A run.
#[derive(Clone, Debug)]
pub struct Run {
    /// Iterations of a step in the mean; `None` for a method without.
    pub iterations: Option<f64>,
    /// The value of the tuned key.
    pub value: Option<f64>,
    /// Median time of a step after the first, ms.
    pub milliseconds: f64,
    /// Distances from the converged steps and from the exact motion; `None` after a failure.
    pub solver_error: Option<f64>,
    pub total_error: Option<f64>,
    /// Elements that are inverted at the end.
    pub inverted: usize,
    /// `done`, or the failure.
    pub outcome: String,
}

impl Run {
    /// Returns true if the run reached its end, with finite positions.
    pub fn is_done(&self) -> bool {
        self.total_error.is_some()
    }

    /// Returns true if the run did not reach its end, or inverted elements, which no converged motion here does.
    pub fn has_failed(&self) -> bool {
        !self.is_done() || self.inverted > 0
    }
}

/// Runs a method with more and more iterations.
pub fn sweep(case: &Case, measures: &Measures, contender: &Contender, limits: Limits) -> Vec<Run> {
    let value = tuned(case, measures, contender);
    let levels: &[usize] = match contender.sweep {
        Sweep::Newton => &DIGITS,
        Sweep::Iterations => &COUNTS,
        Sweep::Whole => &[0],
    };
    let mut runs = Vec::new();
    for &iterations in levels.iter().filter(|iterations| **iterations <= limits.iterations) {
        let found = run(case, measures, contender, iterations, value);
        let is_last =
            found.milliseconds > limits.milliseconds || found.solver_error.is_some_and(|error| error < CONVERGED);
        runs.push(found);
        if is_last {
            break;
        }
    }
    runs
}

/// The value of the tuned key with the smallest error: from the converged steps, or from the exact motion for a method that has none.
fn tuned(case: &Case, measures: &Measures, contender: &Contender) -> Option<f64> {
    let (_, values) = contender.tuned?;
    let error = |value: f64| {
        let found = run(case, measures, contender, TUNED_AT, Some(value));
        found.solver_error.or(found.total_error).unwrap_or(f64::INFINITY)
    };
    let errors: Vec<(f64, f64)> = values.iter().map(|&value| (value, error(value))).collect();
    errors.iter().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(value, _)| *value)
}

fn run(case: &Case, measures: &Measures, contender: &Contender, iterations: usize, value: Option<f64>) -> Run {
    let mut times = Vec::with_capacity(case.steps);
    let end = steps(case, contender, iterations, value, &mut times).map_err(|failure| failure.to_string());
    if times.len() > 1 {
        times.remove(0);
    }
    let measured = end.as_ref().ok().map(|end| (measures.solver_error(&end.q), measures.total_error(&end.q)));
    let measured = measured.filter(|(solver, total)| solver.is_finite() && total.is_finite());
    let newton = end.as_ref().map_or(0.0, |end| end.newton_iterations);
    Run {
        iterations: match contender.sweep {
            Sweep::Newton => Some(newton),
            Sweep::Iterations => Some(iterations as f64),
            Sweep::Whole => None,
        },
        value,
        milliseconds: median_and_p95(times).0,
        solver_error: measured.map(|(error, _)| error).filter(|_| contender.has_solver_error()),
        total_error: measured.map(|(_, error)| error),
        inverted: end.as_ref().map_or(0, |end| end.inverted),
        outcome: match end {
            Err(failure) => format!("failed: {}", failure.split_whitespace().collect::<Vec<_>>().join(" ")),
            Ok(_) if measured.is_none() => "failed: positions are not finite".to_owned(),
            Ok(End { inverted: 0, .. }) => "done".to_owned(),
            Ok(End { inverted, .. }) => format!("failed: {inverted} inverted elements"),
        },
    }
}

/// Positions (m) at the end, the number of inverted elements, Newton iterations of a step in the mean.
struct End {
    q: DVector<f64>,
    inverted: usize,
    newton_iterations: f64,
}

/// Takes the steps of a run, and adds their times, ms.
fn steps(
    case: &Case,
    contender: &Contender,
    iterations: usize,
    value: Option<f64>,
    times: &mut Vec<f64>,
) -> Result<End> {
    let method = contender.method(case.dt(), iterations, value);
    let mut simulation = Simulator::<f64>::new(case.body(contender.model)?, &method)?;
    for _ in 0..case.steps {
        let begun = Instant::now();
        let outcome = simulation.step();
        times.push(1e3 * begun.elapsed().as_secs_f64());
        outcome?;
    }
    let newton_iterations = simulation.counters().newton_iterations as f64 / case.steps as f64;
    Ok(End { q: simulation.positions(), inverted: simulation.inverted_elements(), newton_iterations })
}

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
