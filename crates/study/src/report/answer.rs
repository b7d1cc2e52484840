//! The first screen: which method for which error.

use super::Report;
use crate::report::text::{number, percent, seconds, step, trimmed};
use crate::runs::row::Row;
use crate::studies::scene::{SceneStudy, competing_error};
use fem_chart::escape;

/// Errors that people ask for, as parts of the body's length.
pub const BUDGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// The answers of all scenes.
pub fn html(report: &Report) -> String {
    let mut html = "<h2 id=\"answers\">Which method for my error?</h2>\n".to_owned();
    for study in &report.scenes {
        let sentence = sentence(study);
        html.push_str(&format!("<p class=\"answer\"><b>{}</b>: {}</p>\n", escape(&study.name), escape(&sentence)));
    }
    html
}

/// The fastest run within an error, on the scene's own mesh.
pub fn fastest(study: &SceneStudy, budget: f64) -> Option<&Row> {
    let own = |row: &&Row| row.is_done() && row.config.nodes == study.size.0;
    let within = |row: &&Row| competing_error(row).is_some_and(|error| error <= budget);
    let candidates = study.rows.iter().filter(own).filter(within).filter(|row| row.seconds().is_some());
    candidates.min_by(|a, b| a.seconds().unwrap_or(f64::NAN).total_cmp(&b.seconds().unwrap_or(f64::NAN)))
}

/// One sentence.
pub fn sentence(study: &SceneStudy) -> String {
    if study.horizon == 0.0 {
        return equilibrium(study);
    }
    if study.references.is_empty() {
        let why = study.left_out.iter().find(|(what, _)| what == "errors in time").map_or("", |(_, why)| why);
        return format!("nothing can be said of errors in time: {why}. Times and counts are below.");
    }
    let mut parts: Vec<String> = Vec::new();
    for budget in BUDGETS {
        let part = match fastest(study, budget) {
            Some(row) => format!(
                "{} of its length, {} at dt = {} ({}, {})",
                percent(budget),
                row.config.method,
                step(row.config.dt),
                seconds(row.seconds()),
                real_time(row, study.horizon)
            ),
            None => format!("{} of its length, none of these runs", percent(budget)),
        };
        parts.push(part);
    }
    let mesh =
        study.richardson.as_ref().and_then(|nested| nested.errors.get(1)).map_or(String::new(), |level| {
            format!(" – mind that its mesh alone is {} % off", trimmed(100.0 * level.1))
        });
    format!("for {} s of motion with an error in time of {}{mesh}.", trimmed(study.horizon), parts.join("; of "))
}

/// How a run compares with the clock on the wall.
fn real_time(row: &Row, horizon: f64) -> String {
    match row.seconds().map(|seconds| horizon / seconds) {
        Some(ratio) if ratio >= 1.0 => format!("{} times faster than real time", number(Some(ratio))),
        Some(ratio) => format!("{} times slower than real time", number(Some(1.0 / ratio))),
        None => "not timed".to_owned(),
    }
}

fn equilibrium(study: &SceneStudy) -> String {
    let timed = study
        .rows
        .iter()
        .filter(|row| row.is_done() && row.config.nodes == study.size.0 && row.config.precision == "f64");
    let best = timed.min_by(|a, b| a.seconds().unwrap_or(f64::NAN).total_cmp(&b.seconds().unwrap_or(f64::NAN)));
    let Some(row) = best else { return "no run came to its end.".to_owned() };
    let error = row.errors.analytic.map_or(String::new(), |error| {
        format!(", {} from the closed form", if error < 1e-9 { number(Some(error)) } else { percent(error) })
    });
    let finer: Vec<String> = study
        .rows
        .iter()
        .filter(|row| row.config.group == "mesh" && row.is_done())
        .filter_map(|row| {
            Some(format!("{} ({}, {})", row.config.method, percent(row.errors.analytic?), seconds(row.seconds())))
        })
        .collect();
    let finer = if finer.is_empty() { String::new() } else { format!("; other meshes: {}", finer.join(", ")) };
    format!(
        "the equilibrium on its own mesh is fastest by {} ({}{error}){finer}.",
        row.config.method,
        seconds(row.seconds())
    )
}
