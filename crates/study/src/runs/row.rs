//! A row of a study: configuration, errors, times and counters of a run. The columns of `runs.csv`, and rows as CSV and as JSON.

use fem_model::Integrator;
use fem_model::simulation::Counters;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::machine::Machine;
use crate::study::csv_text;

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

/// A column: its name and its value; a missing value, an infinity and a NaN are null.
type Column = (&'static str, fn(&Row) -> Json);

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
    ("max_it", |row| row.config.max_iterations.into()),
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

/// All rows; the first line names the columns, and the last columns of every row describe the machine.
pub fn csv(rows: &[Row], machine: &Machine) -> Result<String, csv::Error> {
    let machine = machine_cells(machine);
    let names: Vec<&str> = COLUMNS.iter().map(|column| column.0).chain(machine.iter().map(|cell| cell.0)).collect();
    let cells = |row: &Row| {
        let own = COLUMNS.iter().map(|(_, value)| written(value(row)));
        own.chain(machine.iter().map(|cell| cell.1.clone())).collect::<Vec<_>>()
    };
    csv_text(&names, rows.iter().map(cells))
}

/// One object for each row; a missing value is null.
pub fn json(rows: &[Row]) -> Json {
    let object = |row: &Row| {
        let entries = COLUMNS.iter().map(|(name, value)| ((*name).to_owned(), value(row)));
        Json::Object(entries.collect::<Map<_, _>>())
    };
    Json::Array(rows.iter().map(object).collect())
}

fn machine_cells(machine: &Machine) -> [(&'static str, String); 5] {
    let Machine { cpu, threads, flags, commit, date, .. } = machine;
    [
        ("threads", threads.to_string()),
        ("commit", commit.clone()),
        ("cpu", cpu.clone()),
        ("flags", flags.clone()),
        ("date", date.clone()),
    ]
}

fn written(value: Json) -> String {
    match value {
        Json::String(text) => text,
        Json::Number(number) if number.is_f64() => number.as_f64().map_or(String::new(), |x| format!("{x:e}")),
        Json::Number(count) => count.to_string(),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use fem_model::Integrator;

    use super::*;

    #[test]
    fn every_line_has_every_column_and_missing_values_are_empty() {
        let text = String::new;
        let config = Configuration {
            id: text(),
            scene: text(),
            group: text(),
            method: text(),
            pipeline: text(),
            mesh_hash: text(),
            nodes: 4,
            elements: 1,
            young: None,
            poisson: None,
            integrator: Integrator::Static,
            projection: text(),
            solver: text(),
            dt: 1.0,
            steps: 1,
            tolerance: None,
            max_iterations: None,
            precision: text(),
        };
        let row = Row::new(config, text(), text());
        let machine = Machine::this(std::path::Path::new("."));
        let table = csv(std::slice::from_ref(&row), &machine).unwrap();
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let column = reader.headers().unwrap().iter().position(|name| name == "err_time_L2").unwrap();
        let cells = reader.records().next().unwrap().unwrap();
        assert_eq!((cells.len(), &cells[column]), (reader.headers().unwrap().len(), ""));
        assert_eq!(json(&[row])[0]["err_time_L2"], Json::Null);
    }
}
