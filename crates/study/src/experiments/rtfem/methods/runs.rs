//! Runs of a method on a case: with more and more iterations until its error is round-off or its steps take long.

use std::time::Instant;

use nalgebra::DVector;

use super::super::setting::median_and_p95;
use super::case::{Case, Measures};
use super::contenders::{Contender, Sweep};

/// Digits of Newton's tolerance, and iterations of a step, one run for each.
const NEWTON: [usize; 5] = [1, 3, 5, 8, 12];
const ITERATED: [usize; 12] = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

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
        Sweep::Newton => &NEWTON,
        Sweep::Iterations => &ITERATED,
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
    let Ended { mut times, end } = steps(case, contender, &contender.tables(iterations, value));
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

/// The times of the steps, ms, and their end or the failure.
struct Ended {
    times: Vec<f64>,
    end: Result<End, String>,
}

/// Positions (m) at the end, the number of inverted elements, Newton iterations of a step in the mean.
struct End {
    q: DVector<f64>,
    inverted: usize,
    newton_iterations: f64,
}

fn steps(case: &Case, contender: &Contender, tables: &str) -> Ended {
    let mut times = Vec::with_capacity(case.steps);
    let mut simulation = match case.simulation(contender.model, contender.integrator, tables) {
        Ok(simulation) => simulation,
        Err(refusal) => return Ended { times, end: Err(refusal) },
    };
    for _ in 0..case.steps {
        let begun = Instant::now();
        let outcome = simulation.step();
        times.push(1e3 * begun.elapsed().as_secs_f64());
        if let Err(failure) = outcome {
            return Ended { times, end: Err(failure.to_string()) };
        }
    }
    let newton_iterations = simulation.counters().newton_iterations as f64 / case.steps as f64;
    let inverted = simulation.inverted_elements();
    Ended { times, end: Ok(End { q: simulation.positions(), inverted, newton_iterations }) }
}
