//! What the page tells of one scene.

use super::{charts, orders_in_time};
use crate::report::text::{number, percent, seconds, step, trimmed};
use crate::runs::row::Row;
use crate::studies::scene::{SceneStudy, competing_error};
use fem_chart::escape;
use fem_chart::page::{details, figure, table};

/// A scene's part of the page.
pub fn html(study: &SceneStudy) -> String {
    let name = escape(&study.name);
    let mut html = format!("<h2 id=\"{name}\">{name}</h2>\n<p class=\"soft\">{}</p>\n", escape(&intro(study)));
    let caption = "Each dot is a run; rest on it, or touch it, to see which. Rings mark the Pareto front: whatever is as exact, to 2 %, is \
        slower, beyond the quartiles of both (the short lines). Dotted: 4 and 16 ms for each 1/60 s of motion.";
    html.push_str(&figure(&charts::error_against_time(study), caption));
    html.push_str("<h3>Runs that no other beats</h3>\n");
    html.push_str(&front(study));
    if study.horizon > 0.0 {
        html.push_str("<div class=\"charts\">\n");
        html.push_str(&figure(&charts::convergence(study), "Behind each method the order of its finest runs."));
        if let Some(picture) = charts::drift(study) {
            html.push_str(&figure(
                &picture,
                "Zero is where a conservative system stays; a pull that moves does work on it.",
            ));
        }
        html.push_str("</div>\n<h3>Orders, and what is kept</h3>\n");
        html.push_str(&orders(study));
        if let Some(picture) = charts::where_time_goes(study) {
            html.push_str("<h3>Where the time of a step goes</h3>\n");
            let caption = "Each part was timed by itself and multiplied by how often the run's counters say it was done; the last kind \
                is what is left of the measured step.";
            html.push_str(&figure(&picture, caption));
        }
    }
    html.push_str(&mesh(study));
    html.push_str("<h3>One choice at a time</h3>\n");
    html.push_str(&variants(study));
    html.push_str(&details("Runs that failed or are dominated", &beaten(study)));
    html.push_str(&details("All runs", &runs(&study.rows.iter().collect::<Vec<_>>())));
    if !study.left_out.is_empty() {
        let rows: Vec<_> = study.left_out.iter().map(|(what, why)| vec![what.clone(), why.clone()]).collect();
        html.push_str(&details("Left out, and why", &table(&["what", "why"], &rows)));
    }
    html
}

fn intro(study: &SceneStudy) -> String {
    let (nodes, elements) = study.size;
    let motion = if study.horizon > 0.0 {
        format!("; {} s of motion, fastest vibration {} 1/s", trimmed(study.horizon), number(Some(study.fastest)))
    } else {
        "; equilibrium".to_owned()
    };
    format!("{}: {nodes} nodes, {elements} tetrahedra{motion}.", study.about)
}

const HEAD: [&str; 11] = [
    "run",
    ">time step",
    ">error",
    ">total",
    ">quartiles",
    ">processor",
    ">a step",
    ">forces",
    ">Newton",
    ">factors",
    ">solver",
];

fn line(row: &Row) -> Vec<String> {
    let [low, _, high] = row.times.total_s;
    vec![
        row.config.method.clone(),
        step(row.config.dt),
        number(competing_error(row)),
        seconds(row.seconds()),
        format!("{} – {}", seconds(low), seconds(high)),
        seconds(row.times.processor_s),
        seconds(row.times.step_ms[0].map(|ms| ms / 1e3)),
        row.counters.force_assemblies.to_string(),
        row.counters.newton_iterations.to_string(),
        row.counters.factorizations.to_string(),
        row.counters.solver_iterations.to_string(),
    ]
}

fn front(study: &SceneStudy) -> String {
    let mut rows: Vec<&Row> = study
        .rows
        .iter()
        .filter(|row| ["front", "tie"].contains(&row.standing) && row.config.nodes == study.size.0)
        .collect();
    rows.sort_by(|a, b| a.seconds().unwrap_or(f64::NAN).total_cmp(&b.seconds().unwrap_or(f64::NAN)));
    let line = |row: &&Row| {
        let mut cells = line(row);
        cells.insert(0, if row.standing == "front" { "front" } else { "within the spread" }.to_owned());
        cells
    };
    let head: Vec<&str> = std::iter::once("standing").chain(HEAD).collect();
    table(&head, &rows.iter().map(line).collect::<Vec<_>>())
}

fn orders(study: &SceneStudy) -> String {
    let mut rows = Vec::new();
    for observed in orders_in_time(study) {
        let of = study.rows.iter().filter(|row| row.config.method == observed.method);
        let finest = of.clone().filter(|row| row.is_done()).min_by(|a, b| a.config.dt.total_cmp(&b.config.dt));
        let failed = of.filter(|row| !row.is_done()).count();
        let kept = |value: fn(&Row) -> Option<f64>| number(finest.and_then(value));
        rows.push(vec![
            observed.method.clone(),
            observed.order.map_or("–".to_owned(), |order| order.text()),
            observed.expected.to_string(),
            failed.to_string(),
            finest.map_or("–".to_owned(), |row| step(row.config.dt)),
            kept(|row| row.errors.energy),
            kept(|row| row.errors.momentum),
            kept(|row| row.errors.angular),
        ]);
    }
    let head = [
        "method",
        ">order in dt (95 %)",
        ">theory",
        ">runs that failed",
        ">finest step",
        ">energy",
        ">momentum",
        ">angular momentum",
    ];
    let note = "<p class=\"soft\">Energy and momenta: distance of the finest run from the reference at the end, relative. Orders are of \
        the four finest runs; what is driven by its fast vibrations shows its order only at steps below them.</p>\n";
    table(&head, &rows) + note
}

fn mesh(study: &SceneStudy) -> String {
    let Some(nested) = &study.richardson else { return String::new() };
    let rows: Vec<_> =
        nested.errors.iter().map(|(cells, l2, h1)| vec![cells.to_string(), percent(*l2), percent(*h1)]).collect();
    let head = [">cells per metre", ">displacement, of the body's length", ">its gradient, relative"];
    let is_seen = nested.orders.0 > 0.5 && nested.orders.1 > 0.5;
    let caution =
        if is_seen { "" } else { " These meshes are too coarse to show an order, so take the figures as rough." };
    format!(
        "<h3>The mesh's own error</h3>\n<p>Three nested meshes and Richardson's extrapolation: order {} in L2, {} in H1.{caution}</p>\n{}",
        number(Some(nested.orders.0)),
        number(Some(nested.orders.1)),
        table(&head, &rows)
    )
}

/// Rows of all groups but the ladders, beside the base that they vary.
fn variants(study: &SceneStudy) -> String {
    let mut rows: Vec<&Row> = Vec::new();
    for group in ["tolerance", "solver", "projection", "precision", "mesh"] {
        rows.extend(study.rows.iter().filter(|row| row.config.group == group));
    }
    let Some(first) = rows.first() else { return String::new() };
    let base = study.rows.iter().find(|row| row.config.group == "method" && row.config.dt == first.config.dt);
    let all: Vec<&Row> = base.into_iter().chain(rows).collect();
    let line = |row: &&Row| {
        let mut cells = line(row);
        let group = if row.config.group == "method" { "base" } else { &row.config.group };
        cells.insert(0, group.to_owned());
        cells.push(row.status.clone());
        cells
    };
    let head: Vec<&str> = std::iter::once("varied").chain(HEAD).chain(["status"]).collect();
    table(&head, &all.iter().map(line).collect::<Vec<_>>())
}

fn beaten(study: &SceneStudy) -> String {
    let rows: Vec<&Row> = study.rows.iter().filter(|row| !row.is_done() || row.standing == "dominated").collect();
    runs(&rows)
}

fn runs(rows: &[&Row]) -> String {
    let line = |row: &&Row| {
        let mut cells = line(row);
        cells.insert(0, row.config.id.clone());
        cells.push(if row.is_done() {
            row.standing.to_owned()
        } else {
            format!("<span class=\"wide\">{}</span>", escape(&row.status))
        });
        cells
    };
    let head: Vec<&str> = std::iter::once("id").chain(HEAD).chain(["standing"]).collect();
    table(&head, &rows.iter().map(line).collect::<Vec<_>>())
}
