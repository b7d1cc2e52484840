//! `regrade.csv` and `regrade.html`: points that changed since the run before, old beside new.

use std::io;

use maud::{Markup, html};

use super::page::{name, page};
use super::{csv, escape, view};
use crate::class::Change;

/// The text of `regrade.csv`: a row for each student and function whose points changed, and one for each whole score.
pub fn csv(changes: &[Change]) -> io::Result<String> {
    let heading = ["student", "submission", "function", "old_points", "new_points"].map(str::to_owned).to_vec();
    let rows = changes.iter().flat_map(|change| {
        let whole = [("", Some(change.before.score), Some(change.after.score))];
        let parts = whole.into_iter().chain(change.functions());
        let row = |(part, before, after): (&str, Option<f64>, Option<f64>)| {
            let texts = [&change.student, &change.after.submission, part].map(escape::cell);
            texts.into_iter().chain([points(before), points(after)]).collect()
        };
        parts.map(row).collect::<Vec<Vec<String>>>()
    });
    csv::text(heading, rows)
}

/// The same for a terminal, one line for each student.
pub fn text(changes: &[Change]) -> String {
    let mut text = String::new();
    if !changes.is_empty() {
        text.push_str(&format!("points changed: {}, see regrade.html\n", changes.len()));
    }
    for change in changes {
        let parts: Vec<String> = change
            .functions()
            .into_iter()
            .map(|(part, before, after)| format!("{} {} -> {}", escape::line(part), shown(before), shown(after)))
            .collect();
        let parts = if parts.is_empty() { String::new() } else { format!("  ({})", parts.join(", ")) };
        text.push_str(&format!("  {}: {}{parts}\n", escape::line(&change.student), scores(change)));
    }
    text
}

/// The text of `regrade.html`.
pub fn html(changes: &[Change]) -> String {
    let row = |change: &Change| -> Markup {
        html! {
            tr {
                td { (escape::line(&change.student)) } td { (escape::line(&change.after.submission)) }
                td class="right" { (scores(change)) }
                td class="wide" {
                    @for (part, before, after) in change.functions() {
                        div { (name(part)) " " (shown(before)) " → " (shown(after)) }
                    }
                }
            } "\n"
        }
    };
    let body = html! {
        h1 { "Points that changed" }
        div class="scroll" { table {
            tr { th { "student" } th { "submission" } th class="right" { "points" } th { "functions" } } "\n"
            @for change in changes { (row(change)) }
        } }
    };
    page("Points that changed", body)
}

fn scores(change: &Change) -> String {
    let whole = |points: f64, most: f64| format!("{} of {}", view::points(points), view::points(most));
    let (before, after) = (&change.before, &change.after);
    format!("{} -> {}", whole(before.score, before.max_score), whole(after.score, after.max_score))
}

fn shown(points: Option<f64>) -> String {
    points.map_or("–".to_owned(), view::points)
}

fn points(points: Option<f64>) -> String {
    points.map_or(String::new(), view::points)
}
