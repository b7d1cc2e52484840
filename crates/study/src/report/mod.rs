//! The report "error against run time": studies of scenes as tables, charts and a page.

mod adaptive;
mod answer;
mod charts;
mod notes;
mod scene_page;
mod space_charts;
mod space_page;
pub(crate) mod text;

use std::path::{Path, PathBuf};

use maud::{Markup, html};
use serde_json::{Value, json};

use crate::csv_table::csv_text;
use crate::machine::Machine;
use crate::runs::convergence_order::{ConvergenceOrder, asymptotic};
use crate::runs::row::Row;
use crate::runs::table;
use crate::space::{locking, manufactured};
use crate::studies::scene::{self, Question, SceneStudy};
use crate::studies::space::{self, SpaceOrders, SpaceStudy};
use crate::studies::{Settings, make_folders};
use fem_chart::page::page;
use fem_mesh::write::save_bytes;
use fem_model::Integrator;
use fem_scene::{Scene, parse};

/// The results of a report.
#[derive(Clone, Debug)]
pub struct Report {
    /// The machine of the measurements.
    pub machine: Machine,
    /// The short report.
    pub is_quick: bool,
    /// Studies of the requested scenes.
    pub scenes: Vec<SceneStudy>,
    /// The small body that shows the convergence orders in time.
    pub orders: SceneStudy,
    /// Errors in space.
    pub space: SpaceStudy,
}

/// An observed order of convergence.
#[derive(Clone, Debug, PartialEq)]
pub struct Observed {
    /// Name of the scene.
    pub scene: String,
    /// Name of the method.
    pub method: String,
    /// `dt`, `h in L2` or `h in H1`.
    pub of: &'static str,
    /// The order; `None` if too few runs completed.
    pub order: Option<ConvergenceOrder>,
    /// The order of theory.
    pub expected: f64,
}

/// A small soft body with a clamp, gravity and a drag: its initial acceleration is not zero, and its loads depend on time.
const ORDERS: &str = include_str!("orders.toml");

/// Studies the scenes and writes the report into the folder of the settings. An error names the file or the scene.
pub fn report(settings: &Settings, scenes: &[Scene]) -> Result<Report, String> {
    make_folders(&settings.out)?;
    let machine = Machine::this(&settings.data);
    let small = parse(ORDERS, Path::new("orders.toml")).map_err(|error| error.to_string())?;
    let orders = scene::study(settings, &small, Question::Order)?;
    let space = space::study(settings)?;
    let studied = scenes.iter().map(|scene| {
        scene::study(settings, scene, Question::Choice).map_err(|error| format!("{}: {error}", scene.name))
    });
    let scenes = studied.collect::<Result<_, _>>()?;
    let report = Report { machine, is_quick: settings.is_quick, scenes, orders, space };
    write(&report, &settings.out)?;
    Ok(report)
}

impl Report {
    /// Rows of all studies.
    pub fn rows(&self) -> Vec<Row> {
        let studies = std::iter::once(&self.orders).chain(&self.scenes);
        studies.flat_map(|study| &study.rows).chain(&self.space.rows).cloned().collect()
    }

    /// Observed orders in time and in space.
    pub fn observed(&self) -> Vec<Observed> {
        let mut observed = orders_in_time(&self.orders);
        for SpaceOrders { scene, element, observed: orders } in &self.space.orders {
            let expected = manufactured::orders(element);
            for (norm, of) in ["h in L2", "h in H1"].into_iter().enumerate() {
                let (scene, method) = (scene.clone(), manufactured::label(element));
                observed.push(Observed { scene, method, of, order: orders[norm], expected: expected[norm] });
            }
        }
        observed.extend(self.scenes.iter().flat_map(orders_in_time));
        observed
    }

    /// One sentence for each scene: the fastest method for each error.
    pub fn answers(&self) -> Vec<String> {
        self.scenes.iter().map(answer::sentence).collect()
    }
}

/// Number of runs of a fitted order, the finest of the ladder.
const FINEST: usize = 4;

/// Accuracy of the reference: smaller errors are excluded.
const FLOOR: f64 = 1e-11;

/// Order in dt of each method with a ladder.
fn orders_in_time(study: &SceneStudy) -> Vec<Observed> {
    let observe = |method: &str| {
        let rows = study.rows.iter().filter(|row| row.config.method == method && row.is_done());
        let pairs: Vec<_> = rows.filter_map(|row| Some((row.config.dt, row.errors.time_l2?))).collect();
        let integrator = study.rows.iter().find(|row| row.config.method == method)?.config.integrator;
        let expected = f64::from(Integrator::from_name(integrator)?.facts().order?);
        let order = asymptotic(&pairs, FINEST, FLOOR).filter(|order| order.points > 2);
        Some(Observed { scene: study.name.clone(), method: method.to_owned(), of: "dt", order, expected })
    };
    charts::methods(study).iter().filter_map(|method| observe(method)).collect()
}

fn write(report: &Report, out: &Path) -> Result<(), String> {
    let write =
        |name: &str, text: String| save_bytes(&out.join(name), text.as_bytes()).map_err(|error| error.to_string());
    let rows = report.rows();
    let csv = |text: Result<String, csv::Error>| text.map_err(|error| error.to_string());
    write("runs.csv", csv(table::csv(&rows, &report.machine))?)?;
    write("orders.csv", csv(orders_csv(report))?)?;
    write("locking.csv", csv(locking_csv(report))?)?;
    write("runs.json", serde_json::to_string_pretty(&as_json(report)).map_err(|error| error.to_string())? + "\n")?;
    write("README.txt", notes::README.to_owned())?;
    for (name, picture) in charts::files(report) {
        write(&name, picture.standalone())?;
    }
    write("report.html", page("Error against run time", body(report)))
}

/// The body of the page.
fn body(report: &Report) -> Markup {
    html! {
        (notes::head(report))
        (answer::html(report))
        @for study in &report.scenes { (scene_page::html(study)) }
        (space_page::orders(report))
        (space_page::space(&report.space))
        (notes::method(report))
    }
}

fn orders_csv(report: &Report) -> Result<String, csv::Error> {
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.6}"));
    let row = |observed: Observed| {
        let Observed { scene, method, of, order, expected } = observed;
        let width = order.and_then(|order| order.half_width);
        let points = order.map_or(String::new(), |order| order.points.to_string());
        vec![
            scene,
            method,
            of.to_owned(),
            cell(order.map(|order| order.value)),
            cell(width),
            points,
            expected.to_string(),
        ]
    };
    let head = ["scene", "method", "of", "order", "half_width_95", "points", "expected"];
    csv_text(&head, report.observed().into_iter().map(row))
}

fn locking_csv(report: &Report) -> Result<String, csv::Error> {
    let row = |bent: &locking::TipDeflection| {
        vec![bent.poisson.to_string(), bent.cells.to_string(), format!("{:e}", bent.ratio)]
    };
    csv_text(&["poisson", "cells_per_metre", "tip_over_timoshenko"], report.space.tip_deflections.iter().map(row))
}

fn as_json(report: &Report) -> Value {
    let order = |observed: Observed| {
        let order = observed.order;
        json!({
            "scene": observed.scene, "method": observed.method, "of": observed.of, "expected": observed.expected,
            "order": order.map(|order| order.value), "half_width_95": order.and_then(|order| order.half_width),
            "points": order.map(|order| order.points),
        })
    };
    let scene = |study: &SceneStudy| {
        json!({
            "name": study.name, "horizon_s": study.horizon, "fastest_vibration_1_s": study.fastest,
            "references": study.references.iter().map(|(file, check, evaluations)| json!({
                "file": file, "self_check": check.0, "self_check_velocities": check.1, "force_evaluations": evaluations })).collect::<Vec<_>>(),
            "nested_meshes": study.richardson.as_ref().map(|nested| json!({
                "order_L2": nested.orders.0, "order_H1": nested.orders.1,
                "levels": nested.errors.iter().map(|(cells, l2, h1)| json!({
                    "cells_per_metre": cells, "err_space_L2": l2, "err_space_H1": h1 })).collect::<Vec<_>>() })),
            "left_out": study.left_out.iter().map(|(what, why)| json!({ "what": what, "why": why })).collect::<Vec<_>>(),
        })
    };
    json!({
        "format_version": 1,
        "quick": report.is_quick,
        "machine": report.machine,
        "answers": report.answers(),
        "scenes": std::iter::once(&report.orders).chain(&report.scenes).map(scene).collect::<Vec<_>>(),
        "orders": report.observed().into_iter().map(order).collect::<Vec<_>>(),
        "locking": report.space.tip_deflections.iter().map(|bent| json!({
            "poisson": bent.poisson, "cells_per_metre": bent.cells, "tip_over_timoshenko": bent.ratio })).collect::<Vec<_>>(),
        "runs": table::json(&report.rows()),
    })
}

/// The files of a report to open first.
pub fn first_files(out: &Path) -> [PathBuf; 2] {
    [out.join("report.html"), out.join("runs.csv")]
}
