//! The head of the page, and its notes on method and definitions.

use fem_chart::page::table;
use maud::{Markup, PreEscaped, html};

use super::Report;
use super::text::number;

/// The head of the page.
pub(super) fn head(report: &Report) -> Markup {
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
pub(super) fn method(report: &Report) -> Markup {
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
pub(super) const README: &str = include_str!("README.txt");
