//! The short report against the stored tables. An error that the method decides is compared by its digits, and one that a loose tolerance or
//! round-off decides by a bound, `<= …` in the table: digits of such an error differ between processors. Times are not compared.
//!
//! After an intended change, write the tables anew:
//! `FEM_WRITE_REFERENCE=1 cargo test --release -p fem-study --test study`, and give the reason in the commit.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fem_model::Integrator;
use fem_model::simulation::Simulation;
use fem_scene::{Pipeline, Scene};
use fem_study::report::{ErrorStudy, Report};
use fem_study::runs::row::Row;
use fem_study::studies::Settings;
use fem_study::study::{self, Found, Study};

/// Largest relative change of an error or an order.
const CHANGE: f64 = 0.01;

/// Errors below this are round-off, in double and in single precision.
const ROUND_OFF: [f64; 2] = [1e-10, 1e-7];

/// Newton's method to a larger tolerance than this decides the error.
const TIGHT: f64 = 1e-5;

/// Tolerances that a run with loose Newton's method may end away from the converged one: in the mean, and at the worst node. A step leaves up to one
/// at the worst node, and those of several steps partly cancel: 0.6 and 3 were the most on three processors.
const NEWTON: [f64; 2] = [2.0, 10.0];

/// Tolerances of adaptive steps for each step of the scene: docs/book/integrators.md says that the error at the end can be some times their sum.
const ADAPTIVE: [f64; 2] = [0.5, 2.0];

/// The error of Newmark's method with β = 1/12 and the largest stable step (docs/book/studies.md), in the mean and at the worst node; a tenth after each halving.
const NEWMARK: [f64; 2] = [1e-4, 1e-3];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The short report of four scenes with the engine alone, in a folder that exists during the tests.
fn found() -> &'static (Report, tempfile::TempDir) {
    static FOUND: OnceLock<(Report, tempfile::TempDir)> = OnceLock::new();
    FOUND.get_or_init(|| {
        let out = tempfile::tempdir().unwrap();
        let data = root().join("data");
        let factory = |scene: &Scene| -> Result<Box<dyn Simulation>, String> {
            if scene.pipeline == Pipeline::Course {
                return Err("the tests of the study have no course pipeline".to_owned());
            }
            let body = fem_scene::body(scene, &root().join("data")).map_err(|error| error.to_string())?;
            fem_engine::simulator::build(body, &scene.method()).map_err(|refusal| scene.refused(refusal).to_string())
        };
        let scenes = ["arma", "beam", "bar", "cantilever"].map(|name| fem_scene::load(name, &data).unwrap());
        let settings = Settings {
            data: data.clone(),
            out: out.path().to_owned(),
            is_quick: true,
            factory: &factory,
            tell: &|_, _, _| (),
        };
        let study = ErrorStudy { settings, scenes: scenes.into(), names: &[] };
        let found = study::rows(&study);
        let Found { rows, machine, seconds } = &found;
        study.finish(Found { rows: rows.clone(), machine: machine.clone(), seconds: *seconds }, out.path()).unwrap();
        (Report::new(true, found), out)
    })
}

const ERRORS: [&str; 6] = ["run", "err_time_L2", "err_Linf", "err_space_L2", "err_space_H1", "err_analytic"];

/// A number that is compared, and the bound that is stored in place of its digits if the method does not decide them.
struct Entry {
    value: Option<f64>,
    bound: Option<f64>,
    round_off: f64,
}

impl Entry {
    fn stored(&self) -> String {
        match (self.value, self.bound) {
            (None, _) => String::new(),
            (Some(_), Some(bound)) => format!("<= {bound:.1e}"),
            (Some(value), None) if value.abs() < self.round_off => format!("<= {:.1e}", self.round_off),
            (Some(value), None) => format!("{value:.3e}"),
        }
    }

    fn agrees(&self, stored: &str) -> bool {
        match (self.value, stored.strip_prefix("<= ").unwrap_or(stored).parse::<f64>()) {
            (Some(value), Ok(bound)) if stored.starts_with("<= ") => value <= bound,
            (Some(value), Ok(before)) => (value - before).abs() <= CHANGE * before.abs() + self.round_off,
            (value, _) => value.is_none() && stored.is_empty(),
        }
    }
}

/// A row of a table: its name and numbers.
type Line = (String, Vec<Entry>);

/// Name and errors of each run.
fn errors(rows: &[Row]) -> Vec<Line> {
    let line = |row: &Row| {
        let (case, errors) = (&row.config, &row.errors);
        let end = if row.is_done() { "" } else { "; failed" };
        let name = format!("{}; {}; {} nodes; {} steps{end}", case.scene, case.method, case.nodes, case.steps);
        let [mean, worst] = bounds(row, rows).map_or([None; 2], |bounds| bounds.map(Some));
        let values = [
            (errors.time_l2, mean),
            (errors.time_linf, worst),
            (errors.space_l2, None),
            (errors.space_h1, None),
            (errors.analytic, None),
        ];
        let round_off = ROUND_OFF[usize::from(case.precision == "f32")];
        (name, values.map(|(value, bound)| Entry { value, bound, round_off }).into())
    };
    rows.iter().map(line).collect()
}

/// Bounds of the errors in time if a loose tolerance decides them.
fn bounds(row: &Row, rows: &[Row]) -> Option<[f64; 2]> {
    let case = &row.config;
    if let Some((_, tolerance)) = case.method.split_once("adaptive to ") {
        let tolerance: f64 = tolerance.parse().unwrap();
        return Some(ADAPTIVE.map(|part| part * tolerance * case.steps as f64));
    }
    let tolerance = case.tolerance.filter(|&tolerance| tolerance > TIGHT)?;
    let of_scene = || rows.iter().filter(|row| row.config.scene == case.scene);
    if case.method.contains("β = 1/12") {
        let first = of_scene().filter(|row| row.config.method == case.method).map(|row| row.config.steps).min()?;
        return Some(NEWMARK.map(|error| error * 0.1f64.powi((case.steps / first).ilog2() as i32)));
    }
    let is_converged = |row: &&Row| {
        (row.config.group.as_str(), row.config.integrator, row.config.steps) == ("method", case.integrator, case.steps)
    };
    let errors = of_scene().find(is_converged).unwrap_or_else(|| panic!("no converged run beside {case:?}")).errors;
    Some([errors.time_l2? + NEWTON[0] * tolerance, errors.time_linf? + NEWTON[1] * tolerance])
}

fn orders(report: &Report) -> Vec<Line> {
    let line = |observed: fem_study::report::Observed| {
        let value = observed.order.map(|order| order.value);
        let name = format!("{}; {}; {}", observed.scene, observed.method, observed.of);
        (name, vec![Entry { value, bound: None, round_off: ROUND_OFF[0] }])
    };
    report.observed().into_iter().map(line).collect()
}

/// Compares with a stored table, or writes it.
fn compare(file: &str, head: &[&str], lines: &[Line]) {
    let path = root().join("docs/reference").join(file);
    if std::env::var_os("FEM_WRITE_REFERENCE").is_some() {
        let mut writer = csv::Writer::from_path(&path).unwrap();
        writer.write_record(head).unwrap();
        for (name, entries) in lines {
            writer.write_record(std::iter::once(name.clone()).chain(entries.iter().map(Entry::stored))).unwrap();
        }
        writer.flush().unwrap();
        return;
    }
    let mut reader = csv::Reader::from_path(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let stored: BTreeMap<String, csv::StringRecord> =
        reader.records().map(|cells| cells.unwrap()).map(|cells| (cells[0].to_owned(), cells)).collect();
    let mut problems = Vec::new();
    for (name, entries) in lines {
        let Some(before) = stored.get(name) else {
            problems.push(format!("{name}: not in the table"));
            continue;
        };
        for (column, (entry, before)) in head[1..].iter().zip(entries.iter().zip(before.iter().skip(1))) {
            if !entry.agrees(before) {
                problems.push(format!("{name}: {column} is {:?}, stored is {before}", entry.value));
            }
        }
    }
    assert_eq!(lines.len(), stored.len(), "{}: runs were added or are missing", path.display());
    assert!(problems.is_empty(), "{}:\n{}", path.display(), problems.join("\n"));
}

#[test]
fn errors_match_the_stored_table() {
    compare("report-quick-errors.csv", &ERRORS, &errors(&found().0.rows()));
}

#[test]
fn orders_match_the_stored_table() {
    compare("report-quick-orders.csv", &["of", "order"], &orders(&found().0));
}

#[test]
fn digits_that_change_and_a_bound_that_is_exceeded_are_found() {
    let entry = |value: f64, bound| Entry { value: Some(value), bound, round_off: 1e-10 };
    let digits = entry(1.23456e-3, None).stored();
    assert!(entry(1.24e-3, None).agrees(&digits) && !entry(1.25e-3, None).agrees(&digits), "{digits}");
    let bound = entry(1.23456e-3, Some(2e-3)).stored();
    assert!(entry(1e-4, None).agrees(&bound) && !entry(2.1e-3, None).agrees(&bound), "{bound}");
    assert!(!entry(f64::NAN, None).agrees(&bound) && !entry(1.0, None).agrees(""));
    assert!(!Entry { value: None, ..entry(1.0, None) }.agrees(&digits));
}

#[test]
fn every_integrator_has_its_order_on_the_small_body() {
    for observed in found().0.observed().into_iter().filter(|observed| observed.scene == "orders") {
        let order = observed.order.unwrap_or_else(|| panic!("{observed:?}"));
        assert!((order.value - observed.expected).abs() < 0.1, "{observed:?}");
    }
}

#[test]
fn errors_can_be_recomputed_from_the_state_files() {
    let (report, out) = found();
    let read = |file: &str| -> serde_json::Value {
        serde_json::from_str(&fs::read_to_string(out.path().join(file)).unwrap()).unwrap()
    };
    let list = |value: &serde_json::Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let rows = report.rows();
    let row = rows
        .iter()
        .find(|row| row.config.scene == "beam" && row.config.integrator == Integrator::Verlet && row.is_done())
        .unwrap();
    let (state, reference) = (read(&row.state), read(&row.reference_state));
    let (q, exact, weights) = (list(&state["q"]), list(&reference["q"]), list(&reference["weights"]));
    let square: f64 = (0..q.len()).map(|i| weights[i / 3] * (q[i] - exact[i]).powi(2)).sum();
    let error = (square / weights.iter().sum::<f64>()).sqrt() / reference["length"].as_f64().unwrap();
    assert!((error / row.errors.time_l2.unwrap() - 1.0).abs() < 1e-9, "{error} {:?}", row.errors);
}

#[test]
fn diverging_runs_are_failed_rows() {
    let rows = found().0.rows();
    let explicit =
        rows.iter().filter(|row| row.config.scene == "arma" && row.config.integrator == Integrator::ExplicitEuler);
    let statuses: Vec<_> = explicit.map(|row| &row.status).collect();
    assert!(!statuses.is_empty() && statuses.iter().all(|status| status.starts_with("failed: ")), "{statuses:?}");
}

#[test]
fn the_page_and_the_charts_contain_no_nan() {
    let (_, out) = found();
    for file in ["report.html", "error-vs-time.svg", "locking.svg", "orders-in-h.svg", "runs.csv", "orders.csv"] {
        let text = fs::read_to_string(out.path().join(file)).unwrap();
        assert!(!text.is_empty() && !text.contains("NaN"), "{file}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(out.path().join("runs.json")).unwrap()).unwrap();
    assert_eq!(json["runs"].as_array().unwrap().len(), found().0.rows().len());
}
