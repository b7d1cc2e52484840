//! A row of a study: configuration, errors, times and counters of a run. The columns of `runs.csv`.

use fem_model::simulation::Counters;

/// The configuration of a run.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(missing_docs)] // the names are the columns; README.txt of the output explains them
pub struct Configuration {
    pub id: String,
    pub scene: String,
    /// The varied choice.
    pub group: String,
    /// Name of the method.
    pub method: String,
    pub pipeline: &'static str,
    pub mesh_hash: String,
    pub nodes: usize,
    pub elements: usize,
    pub young: Option<f64>,
    pub poisson: Option<f64>,
    pub integrator: &'static str,
    pub projection: &'static str,
    pub solver: String,
    pub dt: f64,
    pub steps: usize,
    pub tolerance: Option<f64>,
    pub max_iterations: Option<usize>,
    pub precision: &'static str,
}

/// Wall-clock times.
#[derive(Clone, Debug, Default, PartialEq)]
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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
#[derive(Clone, Debug, Default, PartialEq)]
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
    pub standing: &'static str,
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

impl Row {
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
            "linearly_implicit_euler" => self.counters.steps,
            _ => self.counters.newton_iterations,
        }
    }

    /// Names and values of all columns except those of the machine.
    pub fn cells(&self) -> Vec<(&'static str, CellValue)> {
        let mut cells = self.of_case();
        cells.extend(self.of_results());
        cells
    }

    fn of_case(&self) -> Vec<(&'static str, CellValue)> {
        let case = &self.config;
        let (text, count) = (|text: &str| CellValue::Text(text.to_owned()), |n: usize| CellValue::Count(Some(n)));
        vec![
            ("id", text(&case.id)),
            ("scene", text(&case.scene)),
            ("group", text(&case.group)),
            ("method", text(&case.method)),
            ("pipeline", text(case.pipeline)),
            ("mesh_hash", text(&case.mesh_hash)),
            ("nodes", count(case.nodes)),
            ("elements", count(case.elements)),
            ("E", CellValue::Number(case.young)),
            ("nu", CellValue::Number(case.poisson)),
            ("integrator", text(case.integrator)),
            ("projection", text(case.projection)),
            ("solver", text(&case.solver)),
            ("dt", CellValue::Number(Some(case.dt))),
            ("steps", count(case.steps)),
            ("tol", CellValue::Number(case.tolerance)),
            ("max_it", CellValue::Count(case.max_iterations)),
            ("precision", text(case.precision)),
        ]
    }

    fn of_results(&self) -> Vec<(&'static str, CellValue)> {
        let Self { times, errors, counters, .. } = self;
        let (number, count) = (CellValue::Number, |n: usize| CellValue::Count(Some(n)));
        let text = |text: &str| CellValue::Text(text.to_owned());
        vec![
            ("setup_ms", number(times.setup_ms)),
            ("step_ms_med", number(times.step_ms[0])),
            ("step_ms_p95", number(times.step_ms[1])),
            ("step_ms_p99", number(times.step_ms[2])),
            ("total_s", number(times.total_s[1])),
            ("total_s_q1", number(times.total_s[0])),
            ("total_s_q3", number(times.total_s[2])),
            ("processor_s", number(times.processor_s)),
            ("repetitions", count(times.repetitions)),
            ("err_time_L2", number(errors.time_l2)),
            ("err_space_L2", number(errors.space_l2)),
            ("err_space_H1", number(errors.space_h1)),
            ("err_Linf", number(errors.time_linf)),
            ("err_analytic", number(errors.analytic)),
            ("dE", number(errors.energy)),
            ("dp", number(errors.momentum)),
            ("dL", number(errors.angular)),
            ("err_estimated", number(errors.estimated)),
            ("newton_it", count(counters.newton_iterations)),
            ("factorizations", count(counters.factorizations)),
            ("lin_solves", count(self.linear_solves())),
            ("solver_it", count(counters.solver_iterations)),
            ("energy_evals", count(counters.energy_evaluations)),
            ("force_evals", count(counters.force_assemblies)),
            ("stiffness_assemblies", count(counters.stiffness_assemblies)),
            ("ls_backtracks", count(counters.line_search_backtracks)),
            ("projections", count(counters.projections)),
            ("unconverged_steps", count(counters.unconverged_steps)),
            ("peak_MB", number(self.peak_mb)),
            ("min_J", number(self.min_j)),
            ("status", text(&self.status)),
            ("pareto", text(self.standing)),
            ("state", text(&self.state)),
            ("reference_state", text(&self.reference_state)),
        ]
    }
}
