//! A row of a study: configuration, errors, times and counters of a run. The columns of `runs.csv`.

use fem_model::Integrator;
use fem_model::simulation::Counters;
use serde::{Deserialize, Serialize};

/// The configuration of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)] // the names are the columns; README.txt of the output explains them
pub struct Configuration {
    pub id: String,
    pub scene: String,
    /// The varied choice.
    pub group: String,
    /// Name of the method.
    pub method: String,
    pub pipeline: String,
    pub mesh_hash: String,
    pub nodes: usize,
    pub elements: usize,
    pub young: Option<f64>,
    pub poisson: Option<f64>,
    pub integrator: Integrator,
    pub projection: String,
    pub solver: String,
    pub dt: f64,
    pub steps: usize,
    pub tolerance: Option<f64>,
    pub max_iterations: Option<usize>,
    pub precision: String,
}

/// Wall-clock times.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Median over the repetitions, ms.
    pub setup_ms: Option<f64>,
    /// Median, 95 % and 99 % of all steps of all repetitions, ms.
    pub step_ms: [Option<f64>; 3],
    /// Lower quartile, median and upper quartile over the repetitions of the time of all steps, s.
    pub total_s: [Option<f64>; 3],
    /// Median over the repetitions of the processor time of all steps in all threads, s.
    pub processor_s: Option<f64>,
    /// Number of timed runs.
    pub repetitions: usize,
}

/// Distances from references; `None` without a reference, or for a run that failed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)] // the names are the columns
pub struct Errors {
    pub time_l2: Option<f64>,
    pub time_linf: Option<f64>,
    pub space_l2: Option<f64>,
    pub space_h1: Option<f64>,
    pub analytic: Option<f64>,
    pub energy: Option<f64>,
    pub momentum: Option<f64>,
    pub angular: Option<f64>,
    /// Sum of the estimated errors of adaptive steps, relative to the body's length.
    pub estimated: Option<f64>,
}

/// The row of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Row {
    pub config: Configuration,
    pub times: Times,
    pub errors: Errors,
    pub counters: Counters,
    pub peak_mb: Option<f64>,
    pub min_j: Option<f64>,
    /// `done`, or the failure.
    pub status: String,
    /// `front`, `tie` or `dominated`; empty if the run is not compared.
    pub standing: String,
    /// Files from which the errors can be recomputed.
    pub state: String,
    pub reference_state: String,
}

/// The value of a cell.
#[derive(Clone, Debug, PartialEq)]
pub enum CellValue {
    /// Text.
    Text(String),
    /// A whole number, or an empty cell.
    Count(Option<usize>),
    /// A number, or an empty cell.
    Number(Option<f64>),
}

impl From<&str> for CellValue {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<usize> for CellValue {
    fn from(count: usize) -> Self {
        Self::Count(Some(count))
    }
}

impl From<Option<f64>> for CellValue {
    fn from(number: Option<f64>) -> Self {
        Self::Number(number)
    }
}

impl Row {
    /// A completed row without results.
    pub fn new(config: Configuration, state: String, reference_state: String) -> Self {
        let (times, errors, counters) = (Times::default(), Errors::default(), Counters::default());
        let (status, standing) = ("done".to_owned(), String::new());
        Self { config, times, errors, counters, peak_mb: None, min_j: None, status, standing, state, reference_state }
    }

    /// Returns true if the run completed.
    pub fn is_done(&self) -> bool {
        self.status.starts_with("done")
    }

    /// Median time of the whole run, s.
    pub fn seconds(&self) -> Option<f64> {
        self.times.total_s[1]
    }

    /// Linear systems solved for steps or Newton directions.
    pub fn linear_solves(&self) -> usize {
        match self.config.integrator {
            Integrator::LinearlyImplicitEuler => self.counters.steps,
            _ => self.counters.newton_iterations,
        }
    }
}

/// A column: its name and its value.
type Column = (&'static str, fn(&Row) -> CellValue);

/// All columns except those of the machine.
pub const COLUMNS: [Column; 52] = [
    ("id", |row| row.config.id.as_str().into()),
    ("scene", |row| row.config.scene.as_str().into()),
    ("group", |row| row.config.group.as_str().into()),
    ("method", |row| row.config.method.as_str().into()),
    ("pipeline", |row| row.config.pipeline.as_str().into()),
    ("mesh_hash", |row| row.config.mesh_hash.as_str().into()),
    ("nodes", |row| row.config.nodes.into()),
    ("elements", |row| row.config.elements.into()),
    ("E", |row| row.config.young.into()),
    ("nu", |row| row.config.poisson.into()),
    ("integrator", |row| row.config.integrator.name().into()),
    ("projection", |row| row.config.projection.as_str().into()),
    ("solver", |row| row.config.solver.as_str().into()),
    ("dt", |row| Some(row.config.dt).into()),
    ("steps", |row| row.config.steps.into()),
    ("tol", |row| row.config.tolerance.into()),
    ("max_it", |row| CellValue::Count(row.config.max_iterations)),
    ("precision", |row| row.config.precision.as_str().into()),
    ("setup_ms", |row| row.times.setup_ms.into()),
    ("step_ms_med", |row| row.times.step_ms[0].into()),
    ("step_ms_p95", |row| row.times.step_ms[1].into()),
    ("step_ms_p99", |row| row.times.step_ms[2].into()),
    ("total_s", |row| row.times.total_s[1].into()),
    ("total_s_q1", |row| row.times.total_s[0].into()),
    ("total_s_q3", |row| row.times.total_s[2].into()),
    ("processor_s", |row| row.times.processor_s.into()),
    ("repetitions", |row| row.times.repetitions.into()),
    ("err_time_L2", |row| row.errors.time_l2.into()),
    ("err_space_L2", |row| row.errors.space_l2.into()),
    ("err_space_H1", |row| row.errors.space_h1.into()),
    ("err_Linf", |row| row.errors.time_linf.into()),
    ("err_analytic", |row| row.errors.analytic.into()),
    ("dE", |row| row.errors.energy.into()),
    ("dp", |row| row.errors.momentum.into()),
    ("dL", |row| row.errors.angular.into()),
    ("err_estimated", |row| row.errors.estimated.into()),
    ("newton_it", |row| row.counters.newton_iterations.into()),
    ("factorizations", |row| row.counters.factorizations.into()),
    ("lin_solves", |row| row.linear_solves().into()),
    ("solver_it", |row| row.counters.solver_iterations.into()),
    ("energy_evals", |row| row.counters.energy_evaluations.into()),
    ("force_evals", |row| row.counters.force_assemblies.into()),
    ("stiffness_assemblies", |row| row.counters.stiffness_assemblies.into()),
    ("ls_backtracks", |row| row.counters.line_search_backtracks.into()),
    ("projections", |row| row.counters.projections.into()),
    ("unconverged_steps", |row| row.counters.unconverged_steps.into()),
    ("peak_MB", |row| row.peak_mb.into()),
    ("min_J", |row| row.min_j.into()),
    ("status", |row| row.status.as_str().into()),
    ("pareto", |row| row.standing.as_str().into()),
    ("state", |row| row.state.as_str().into()),
    ("reference_state", |row| row.reference_state.as_str().into()),
];
