//! The part of the page about one scene.

use fem_chart::page::{details, figure, table};
use maud::{Markup, html};

use super::text::{number, percent, seconds, step, trimmed};
use super::{Observed, charts, orders_in_time};
use crate::runs::row::Row;
use crate::studies::scene::{SceneStudy, competing_error};
use crate::study::{Column, Table};

/// A scene's part of the page.
pub(super) fn html(study: &SceneStudy) -> Markup {
    let caption = "Each dot is a run; point at a dot for its configuration. Rings mark the Pareto front: every run that is as exact, to 2 %, is slower, \
        beyond the quartiles of both (the short lines). Dotted lines: 4 and 16 ms for each 1/60 s of motion.";
    html! {
        h2 id=(study.name) { (study.name) }
        p class="soft" { (intro(study)) }
        (figure(&charts::error_against_time(study), caption))
        h3 { "Pareto front" }
        (front(study))
        @if study.horizon > 0.0 { (motion(study)) }
        (adaptive(study))
        (mesh(study))
        h3 { "One choice at a time" }
        (variants(study))
        (details("Failed and dominated runs", runs(study.rows.iter().filter(|row| !row.is_done() || row.standing == "dominated"))))
        (details("All runs", runs(study.rows.iter())))
        @if !study.left_out.is_empty() {
            @let rows: Vec<_> = study.left_out.iter().map(|(what, why)| vec![what.clone(), why.clone()]).collect();
            (details("Runs that were left out", table(&["run", "reason"], &rows)))
        }
    }
}

fn intro(study: &SceneStudy) -> String {
    let (nodes, elements) = study.size;
    let motion = if study.horizon > 0.0 {
        format!("; {} s of motion, ω_max = {} 1/s", trimmed(study.horizon), number(Some(study.fastest)))
    } else {
        "; equilibrium".to_owned()
    };
    format!("{}: {nodes} nodes, {elements} tetrahedra{motion}.", study.about)
}

/// Convergence, energy, and the costs of a step.
fn motion(study: &SceneStudy) -> Markup {
    html! {
        div class="charts" {
            (figure(&charts::convergence(study), "The legend gives the convergence order of the finest runs."))
            @if let Some(picture) = charts::drift(study) {
                (figure(&picture, "The total energy of a conservative system stays at zero; a moving load does work."))
            }
        } "\n"
        h3 { "Convergence orders and conservation" }
        (orders(study))
        @if let Some(picture) = charts::costs_of_a_step(study) {
            h3 { "Costs of a step" }
            (figure(&picture, "Each part was timed alone and multiplied by its counter; the last kind is the remainder of the measured step."))
        }
    }
}

/// A column of text.
type TextColumn = (&'static str, fn(&Row) -> String);

/// The columns of tables of runs.
const COLUMNS: [TextColumn; 11] = [
    ("run", |row| row.config.method.clone()),
    (">time step", |row| step(row.config.dt)),
    (">error", |row| number(competing_error(row))),
    (">total", |row| seconds(row.seconds())),
    (">quartiles", |row| format!("{} – {}", seconds(row.times.total_s[0]), seconds(row.times.total_s[2]))),
    (">processor", |row| seconds(row.times.processor_s)),
    (">a step", |row| seconds(row.times.step_ms[0].map(|ms| ms / 1e3))),
    (">forces", |row| row.counters.force_assemblies.to_string()),
    (">Newton", |row| row.counters.newton_iterations.to_string()),
    (">factors", |row| row.counters.factorizations.to_string()),
    (">solver", |row| row.counters.solver_iterations.to_string()),
];

/// Name and cells of a column of markup.
type MarkupColumn<'a> = (&'a str, fn(&Row) -> Markup);

/// A table of runs: a cell before and cells behind those of [`COLUMNS`].
fn table_of_runs<'a>(
    rows: impl IntoIterator<Item = &'a Row>,
    first: (&str, impl Fn(&Row) -> String),
    last: Option<MarkupColumn>,
) -> Markup {
    let line = |row: &Row| {
        let mut cells = vec![html! { (first.1(row)) }];
        cells.extend(COLUMNS.iter().map(|(_, cell)| html! { (cell(row)) }));
        cells.extend(last.map(|(_, cell)| cell(row)));
        cells
    };
    let head: Vec<&str> =
        std::iter::once(first.0).chain(COLUMNS.map(|column| column.0)).chain(last.map(|(name, _)| name)).collect();
    table(&head, &rows.into_iter().map(line).collect::<Vec<_>>())
}

fn front(study: &SceneStudy) -> Markup {
    let competes = |row: &&Row| ["front", "tie"].contains(&row.standing.as_str()) && row.config.nodes == study.size.0;
    let mut rows: Vec<&Row> = study.rows.iter().filter(competes).collect();
    rows.sort_by(|a, b| a.seconds().unwrap_or(f64::NAN).total_cmp(&b.seconds().unwrap_or(f64::NAN)));
    let standing = |row: &Row| if row.standing == "front" { "front" } else { "within the spread" }.to_owned();
    table_of_runs(rows, ("standing", standing), None)
}

fn orders(study: &SceneStudy) -> Markup {
    let of =
        |observed: &Observed| study.rows.iter().filter(|row| row.config.method == observed.method).collect::<Vec<_>>();
    let finest = |observed: &Observed| {
        let done = of(observed).into_iter().filter(|row| row.is_done());
        done.min_by(|a, b| a.config.dt.total_cmp(&b.config.dt))
    };
    let columns: [Column<Observed>; 8] = [
        ("method", &|observed| observed.method.clone()),
        (">order in dt (95 %)", &|observed| observed.order.map_or("–".to_owned(), |order| order.text())),
        (">theory", &|observed| observed.expected.to_string()),
        (">failed runs", &|observed| of(observed).iter().filter(|row| !row.is_done()).count().to_string()),
        (">finest step", &|observed| finest(observed).map_or("–".to_owned(), |row| step(row.config.dt))),
        (">energy", &|observed| number(finest(observed).and_then(|row| row.errors.energy))),
        (">momentum", &|observed| number(finest(observed).and_then(|row| row.errors.momentum))),
        (">angular momentum", &|observed| number(finest(observed).and_then(|row| row.errors.angular))),
    ];
    html! {
        (Table::of("orders", &orders_in_time(study), &columns).html())
        p class="soft" {
            "Energy and momenta: relative distance of the finest run from the reference at the end. Orders are fitted to the four finest runs. \
             High frequencies hide the order until the time step resolves them."
        } "\n"
    }
}

fn mesh(study: &SceneStudy) -> Markup {
    let Some(estimate) = &study.richardson else { return html! {} };
    let row = |(cells, l2, h1): &(usize, f64, f64)| vec![cells.to_string(), percent(*l2), percent(*h1)];
    let rows: Vec<_> = estimate.errors.iter().map(row).collect();
    let is_asymptotic = estimate.orders.0 > 0.5 && estimate.orders.1 > 0.5;
    html! {
        h3 { "Error in space" }
        p {
            "Richardson extrapolation over three nested meshes: order " (number(Some(estimate.orders.0))) " in L2, "
            (number(Some(estimate.orders.1))) " in H1."
            @if !is_asymptotic { " These meshes are too coarse to show an order; the errors are rough estimates." }
        }
        (table(&[">cells per metre", ">displacement, relative to the length", ">gradient, relative"], &rows))
    }
}

/// The base configuration, and runs that differ from it in one choice.
fn variants(study: &SceneStudy) -> Markup {
    let groups = ["tolerance", "solver", "projection", "precision", "mesh"];
    let rows: Vec<&Row> =
        groups.iter().flat_map(|group| study.rows.iter().filter(move |row| row.config.group == *group)).collect();
    let Some(first) = rows.first() else { return html! {} };
    let base = study.rows.iter().find(|row| row.config.group == "method" && row.config.dt == first.config.dt);
    let group = |row: &Row| if row.config.group == "method" { "base".to_owned() } else { row.config.group.clone() };
    table_of_runs(base.into_iter().chain(rows), ("varied", group), Some(("status", |row| html! { (row.status) })))
}

fn runs<'a>(rows: impl Iterator<Item = &'a Row>) -> Markup {
    let standing = |row: &Row| {
        html! { @if row.is_done() { (row.standing) } @else { span class="wide" { (row.status) } } }
    };
    table_of_runs(rows, ("id", |row: &Row| row.config.id.clone()), Some(("standing", standing)))
}

/// The table and the chart.
fn adaptive(study: &SceneStudy) -> Markup {
    let Some(picture) = charts::adaptive(study) else { return html! {} };
    let columns: [Column<&Row>; 7] = [
        ("run", &|row| row.config.method.clone()),
        (">steps", &|row| row.counters.accepted_steps.to_string()),
        (">rejected", &|row| row.counters.rejected_steps.to_string()),
        (">estimated error", &|row| number(row.errors.estimated)),
        (">true error", &|row| number(row.errors.time_linf)),
        (">true / estimated", &|row| {
            number(row.errors.time_linf.zip(row.errors.estimated).map(|(error, estimated)| error / estimated))
        }),
        (">total", &|row| seconds(row.seconds())),
    ];
    let caption = "Estimates are those of the displacements of each step, added up; true errors are the largest distance from the reference at the \
        end, in which errors of earlier steps have grown or swung back.";
    html! {
        h3 { "Adaptive steps" }
        (figure(&picture, caption))
        (Table::of("adaptive", &charts::adaptive_rows(study).collect::<Vec<_>>(), &columns).html())
    }
}
