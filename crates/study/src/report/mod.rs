//! The report "error against run time": studies of scenes as tables, charts and a page.

mod answer;
mod charts;
mod scene_page;
mod space;
pub(crate) mod text;

use std::io;
use std::path::Path;

use maud::{Markup, PreEscaped, html};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::machine::Machine;
use crate::runs::convergence_order::{ConvergenceOrder, asymptotic};
use crate::runs::row::{self, Row};
use crate::studies::Settings;
use crate::studies::scene::{self, Question, SceneStudy};
use crate::studies::space::{SpaceOrders, SpaceStudy, study as study_space};
use crate::study::{Case, Column, Finished, Found, Problem, Result, Study, Table};
use fem_chart::Picture;
use fem_chart::page::{page, table};
use fem_mesh::write::save_bytes;
use fem_reference::space::{locking, manufactured};
use fem_scene::{Scene, parse};
use text::number;

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

/// The study of scenes, of the orders on a small body, and of errors in space.
pub struct ErrorStudy<'a> {
    /// Folders, extent, and the builder of simulations.
    pub settings: Settings<'a>,
    /// The scenes.
    pub scenes: Vec<Scene>,
    /// Their names as arguments of the program.
    pub names: &'a [String],
}

/// What a case of it becomes.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Studied {
    /// The small body.
    Orders(SceneStudy),
    /// Errors in space.
    Space(SpaceStudy),
    /// A requested scene.
    Scene(SceneStudy),
    /// A scene that cannot be studied, and why.
    Failed(String),
}

impl Study for ErrorStudy<'_> {
    type Row = Studied;

    fn arguments(&self) -> Vec<String> {
        let options = self.settings.is_quick.then(|| "--quick".to_owned());
        ["report".to_owned()].into_iter().chain(self.names.iter().cloned()).chain(options).collect()
    }

    fn cases(&self) -> Vec<Case<'_, Studied>> {
        let failed = |problem: Problem| Studied::Failed(problem.to_string());
        let orders = move || {
            let small = parse(ORDERS, Path::new("orders.toml")).map_err(Problem::from);
            let found = small.and_then(|small| scene::study(&self.settings, &small, Question::Order));
            found.map_or_else(failed, Studied::Orders)
        };
        let space = move || study_space(&self.settings).map_or_else(failed, Studied::Space);
        let of_scene = |of: &'_ Scene| {
            let found = scene::study(&self.settings, of, Question::Choice);
            found.map_or_else(|problem| Studied::Failed(format!("{}: {problem}", of.name)), Studied::Scene)
        };
        let first = [Case::new("orders", orders), Case::new("space", space)];
        first.into_iter().chain(self.scenes.iter().map(|of| Case::new(&of.name, move || of_scene(of)))).collect()
    }

    fn finish(&self, found: Found<Studied>, out: &Path) -> io::Result<Finished> {
        let problems: Vec<String> = found
            .rows
            .iter()
            .filter_map(|row| match row {
                Studied::Failed(problem) => Some(problem.clone()),
                _ => None,
            })
            .collect();
        let report = Report::new(self.settings.is_quick, found);
        write(&report, out).map_err(io::Error::other)?;
        let answers =
            report.scenes.iter().zip(report.answers()).map(|(study, answer)| format!("{}: {answer}", study.name));
        let rows = report.rows();
        let failed = rows.iter().filter(|row| !row.is_done()).count();
        let count = format!("{} runs; {failed} of them failed, as the tables show", rows.len());
        let files = ["report.html", "runs.csv"].map(|file| out.join(file).display().to_string());
        let lines = answers.chain([count]).chain(files).collect();
        Ok(Finished { lines, failed: (!problems.is_empty()).then(|| problems.join("; ")) })
    }
}

impl Report {
    /// The report of the rows of a study.
    pub fn new(is_quick: bool, found: Found<Studied>) -> Self {
        let (orders, space, scenes) = Default::default();
        let mut report = Self { machine: found.machine, is_quick, scenes, orders, space };
        for row in found.rows {
            match row {
                Studied::Orders(study) => report.orders = study,
                Studied::Space(study) => report.space = study,
                Studied::Scene(study) => report.scenes.push(study),
                Studied::Failed(_) => {}
            }
        }
        report
    }

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
        let expected = f64::from(integrator.facts().order?);
        let order = asymptotic(&pairs, FINEST, FLOOR).filter(|order| order.points > 2);
        Some(Observed { scene: study.name.clone(), method: method.to_owned(), of: "dt", order, expected })
    };
    charts::methods(study).iter().filter_map(|method| observe(method)).collect()
}

fn write(report: &Report, out: &Path) -> Result<()> {
    let write = |name: &str, text: String| save_bytes(&out.join(name), text.as_bytes());
    write("runs.csv", row::csv(&report.rows(), &report.machine)?)?;
    write("orders.csv", orders_csv(report)?)?;
    write("locking.csv", locking_csv(report)?)?;
    write("runs.json", serde_json::to_string_pretty(&as_json(report))? + "\n")?;
    write("README.txt", README.to_owned())?;
    for (name, picture) in pictures(report) {
        write(&name, picture.standalone())?;
    }
    Ok(write("report.html", page("Error against run time", body(report)))?)
}

/// Charts that are written as files.
fn pictures(report: &Report) -> Vec<(String, Picture)> {
    let mut files = Vec::new();
    for (place, study) in report.scenes.iter().enumerate() {
        let picture = charts::error_against_time(study);
        if place == 0 {
            files.push(("error-vs-time.svg".to_owned(), picture.clone()));
        }
        files.push((format!("error-vs-time-{}.svg", study.name), picture));
        files.push((format!("convergence-in-dt-{}.svg", study.name), charts::convergence(study)));
        files.extend(charts::adaptive(study).map(|chart| (format!("adaptive-{}.svg", study.name), chart)));
    }
    files.push(("orders-in-dt.svg".to_owned(), charts::convergence(&report.orders)));
    files.push(("orders-in-h.svg".to_owned(), space::in_space(&report.space)));
    files.push(("triangles-error-vs-time.svg".to_owned(), space::time_in_plane(&report.space)));
    files.push(("locking.svg".to_owned(), space::locking_chart(&report.space)));
    files
}

/// The body of the page.
fn body(report: &Report) -> Markup {
    html! {
        (head(report))
        (answer::html(report))
        @for study in &report.scenes { (scene_page::html(study)) }
        (space::orders(report))
        (space::space(&report.space))
        (method(report))
    }
}

/// The head of the page.
fn head(report: &Report) -> Markup {
    html! {
        h1 { "Error against run time" }
        p class="soft" {
            (report.machine.line()) "."
            @if report.is_quick { " This is the short version with small meshes and few steps; its times are not representative." }
            @if report.machine.is_busy() {
                " Other processes used this machine: wall-clock times are too long, and processor times are more reliable."
            }
        } "\n"
    }
}

/// The end of the page.
fn method(report: &Report) -> Markup {
    let references = std::iter::once(&report.orders).chain(&report.scenes).flat_map(|study| &study.references);
    let row = |(file, (u, v), evaluations): &(String, (f64, f64), usize)| {
        vec![file.clone(), number(Some(*u)), number(Some(*v)), evaluations.to_string()]
    };
    let rows: Vec<_> = references.map(row).collect();
    html! {
        (PreEscaped(include_str!("method.html")))
        (table(&["reference in time", ">self-check", ">of velocities", ">force evaluations"], &rows))
        (PreEscaped(include_str!("columns.html")))
    }
}

/// The file that explains the folder without the page.
const README: &str = include_str!("README.txt");

fn orders_csv(report: &Report) -> Result<String, csv::Error> {
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.6}"));
    let columns: [Column<Observed>; 7] = [
        ("scene", &|of| of.scene.clone()),
        ("method", &|of| of.method.clone()),
        ("of", &|of| of.of.to_owned()),
        ("order", &|of| cell(of.order.map(|order| order.value))),
        ("half_width_95", &|of| cell(of.order.and_then(|order| order.half_width))),
        ("points", &|of| of.order.map_or(String::new(), |order| order.points.to_string())),
        ("expected", &|of| of.expected.to_string()),
    ];
    Table::of("orders", &report.observed(), &columns).csv()
}

fn locking_csv(report: &Report) -> Result<String, csv::Error> {
    let columns: [Column<locking::TipDeflection>; 4] = [
        ("elements", &|bent| bent.elements.clone()),
        ("poisson", &|bent| bent.poisson.to_string()),
        ("cells_per_metre", &|bent| bent.cells.to_string()),
        ("tip_over_timoshenko", &|bent| format!("{:e}", bent.ratio)),
    ];
    Table::of("locking", &report.space.tip_deflections, &columns).csv()
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
            "elements": bent.elements, "poisson": bent.poisson, "cells_per_metre": bent.cells, "tip_over_timoshenko": bent.ratio })).collect::<Vec<_>>(),
        "runs": row::json(&report.rows()),
    })
}
