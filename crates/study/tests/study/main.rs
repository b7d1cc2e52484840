//! The short report against the stored tables: errors and orders must not change by more than a hundredth, of adaptive
//! runs a twentieth; times may.
//!
//! After an intended change, write the tables anew:
//! `FEM_WRITE_REFERENCE=1 cargo test --release -p fem-study --test study`, and give the reason in the commit.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fem_scene::simulation::Simulation;
use fem_scene::{Pipeline, Scene};
use fem_study::report::{Report, report};
use fem_study::runs::row::Row;
use fem_study::studies::Settings;

/// Largest relative change of an error or an order.
const CHANGE: f64 = 0.01;

/// The same of adaptive runs: round-off decides whether a step whose estimate is close to its bound is accepted.
const CHANGE_OF_ADAPTIVE: f64 = 0.2;

/// Errors below this are round-off, and differ from machine to machine.
const ROUND_OFF: f64 = 1e-10;

/// The same in single precision.
const ROUND_OFF_OF_SINGLE: f64 = 1e-7;

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
            fem_engine::simulator::build(scene, body).map_err(|error| error.to_string())
        };
        let scenes = ["arma", "beam", "bar", "cantilever"].map(|name| fem_scene::load(name, &data).unwrap());
        let settings = Settings {
            data: data.clone(),
            out: out.path().to_owned(),
            is_quick: true,
            factory: &factory,
            tell: &|_, _, _| (),
        };
        (report(&settings, &scenes).unwrap(), out)
    })
}

/// Name and errors of each run. The errors of loose tolerances depend on round-off in Newton's method.
fn errors(rows: &[Row]) -> Vec<Vec<String>> {
    let is_loose =
        |row: &&Row| row.config.group == "tolerance" && row.config.tolerance.is_some_and(|tolerance| tolerance > 1e-6);
    let line = |row: &Row| {
        let case = &row.config;
        let name = format!("{}; {}; {} nodes; {} steps", case.scene, case.method, case.nodes, case.steps);
        let cell = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.6e}"));
        let errors = &row.errors;
        let status = if row.is_done() { "done" } else { "failed" };
        let mut cells = vec![name, status.to_owned()];
        let values = [errors.time_l2, errors.time_linf, errors.space_l2, errors.space_h1, errors.analytic];
        cells.extend(values.map(cell));
        cells
    };
    rows.iter().filter(|row| !is_loose(row)).map(line).collect()
}

const ERRORS: [&str; 7] = ["run", "status", "err_time_L2", "err_Linf", "err_space_L2", "err_space_H1", "err_analytic"];

fn orders(report: &Report) -> Vec<Vec<String>> {
    let line = |observed: fem_study::report::Observed| {
        let order = observed.order.map_or(String::new(), |order| format!("{:.6}", order.value));
        vec![format!("{}; {}; {}", observed.scene, observed.method, observed.of), order]
    };
    report.observed().into_iter().map(line).collect()
}

/// Compares with a stored table, or writes it.
fn compare(file: &str, head: &[&str], rows: &[Vec<String>]) {
    let path = root().join("docs/reference").join(file);
    if std::env::var_os("FEM_WRITE_REFERENCE").is_some() {
        let mut writer = csv::Writer::from_path(&path).unwrap();
        writer.write_record(head).unwrap();
        rows.iter().for_each(|row| writer.write_record(row).unwrap());
        writer.flush().unwrap();
        return;
    }
    let mut reader = csv::Reader::from_path(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let stored: BTreeMap<String, csv::StringRecord> =
        reader.records().map(|cells| cells.unwrap()).map(|cells| (cells[0].to_owned(), cells)).collect();
    let mut problems = Vec::new();
    for row in rows {
        let Some(before) = stored.get(&row[0]) else {
            problems.push(format!("{}: not in the table", row[0]));
            continue;
        };
        for (place, (now, before)) in row.iter().zip(before).enumerate().skip(1) {
            if !agrees(&row[0], now, before) {
                problems.push(format!("{}: {} is {now}, was {before}", row[0], head[place]));
            }
        }
    }
    assert_eq!(rows.len(), stored.len(), "{}: runs were added or are missing", path.display());
    assert!(problems.is_empty(), "{}:\n{}", path.display(), problems.join("\n"));
}

fn agrees(run: &str, now: &str, before: &str) -> bool {
    let change = if run.contains("adaptive to ") { CHANGE_OF_ADAPTIVE } else { CHANGE };
    let round_off = if run.contains(" in f32;") { ROUND_OFF_OF_SINGLE } else { ROUND_OFF };
    match (now.parse::<f64>(), before.parse::<f64>()) {
        (Ok(now), Ok(before)) => (now - before).abs() <= change * before.abs() + round_off,
        _ => now == before,
    }
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
        .find(|row| row.config.scene == "beam" && row.config.integrator == "verlet" && row.is_done())
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
    let explicit = rows.iter().filter(|row| row.config.scene == "arma" && row.config.integrator == "explicit_euler");
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
