//! The first screen of the report: the fastest method for each error.

use maud::{Markup, html};

use super::Report;
use super::text::{number, percent, seconds, step, trimmed};
use crate::runs::row::Row;
use crate::studies::scene::{SceneStudy, competing_error};

/// Errors that the answers are given for, relative to the body's length.
const BUDGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// The answers of all scenes.
pub(super) fn html(report: &Report) -> Markup {
    html! {
        h2 id="answers" { "Which method for my error?" }
        @for study in &report.scenes {
            p class="answer" { b { (study.name) } ": " (sentence(study)) } "\n"
        }
    }
}

/// The answer of one scene in one sentence.
pub(super) fn sentence(study: &SceneStudy) -> String {
    if study.horizon == 0.0 {
        return equilibrium(study);
    }
    if study.references.is_empty() {
        let why = study.left_out.iter().find(|(what, _)| what == "errors in time").map_or("", |(_, why)| why);
        return format!("the report has no errors in time: {why}. Times and counts are below.");
    }
    let part = |budget: f64| match fastest(study, |row| competing_error(row).is_some_and(|error| error <= budget)) {
        Some(row) => format!(
            "{} of its length: {} at dt = {} ({}, {})",
            percent(budget),
            row.config.method,
            step(row.config.dt),
            seconds(row.seconds()),
            real_time(row, study.horizon)
        ),
        None => format!("{} of its length: no run of this study", percent(budget)),
    };
    let mesh =
        study.richardson.as_ref().and_then(|estimate| estimate.errors.get(1)).map_or(String::new(), |level| {
            format!(". The error in space of its mesh is {} %", trimmed(100.0 * level.1))
        });
    let parts = BUDGETS.map(part).join("; ");
    format!("the fastest runs of {} s of motion with an error in time of {parts}{mesh}.", trimmed(study.horizon))
}

/// The fastest of some runs on the scene's own mesh.
fn fastest(study: &SceneStudy, is_candidate: impl Fn(&Row) -> bool) -> Option<&Row> {
    let own = |row: &&Row| row.is_done() && row.config.nodes == study.size.0 && row.seconds().is_some();
    let candidates = study.rows.iter().filter(own).filter(|row| is_candidate(row));
    candidates.min_by(|a, b| a.seconds().unwrap_or(f64::NAN).total_cmp(&b.seconds().unwrap_or(f64::NAN)))
}

/// Run time relative to the simulated time.
fn real_time(row: &Row, horizon: f64) -> String {
    match row.seconds().map(|seconds| horizon / seconds) {
        Some(ratio) if ratio >= 1.0 => format!("{} times faster than real time", number(Some(ratio))),
        Some(ratio) => format!("{} times slower than real time", number(Some(1.0 / ratio))),
        None => "not timed".to_owned(),
    }
}

fn equilibrium(study: &SceneStudy) -> String {
    let Some(row) = fastest(study, |row| row.config.precision == "f64") else {
        return "no run reached equilibrium.".to_owned();
    };
    let error = row.errors.analytic.map_or(String::new(), |error| {
        format!(", {} from the closed form", if error < 1e-9 { number(Some(error)) } else { percent(error) })
    });
    let other_meshes: Vec<String> = study
        .rows
        .iter()
        .filter(|row| row.config.group == "mesh" && row.is_done())
        .filter_map(|row| {
            Some(format!("{} ({}, {})", row.config.method, percent(row.errors.analytic?), seconds(row.seconds())))
        })
        .collect();
    let other_meshes =
        if other_meshes.is_empty() { String::new() } else { format!("; other meshes: {}", other_meshes.join(", ")) };
    format!(
        "the fastest equilibrium on its own mesh is that of {} ({}{error}){other_meshes}.",
        row.config.method,
        seconds(row.seconds())
    )
}
