//! The files of an experiment: a table for each table, a picture for each picture, a page for readers.

use std::io;
use std::path::Path;

use fem_chart::page::{figure, page, table};
use maud::{Markup, html};

use super::{Experiment, Mark, Part};
use crate::csv_table::csv_text;

/// Writes the page, the tables (`.csv`) and the pictures (`.svg`) of an experiment into a folder.
pub fn write(experiment: &Experiment, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    for part in &experiment.parts {
        for table in &part.tables {
            let head: Vec<&str> = table.head.iter().map(|name| name.trim_start_matches('>')).collect();
            let text = csv_text(&head, table.rows.iter().cloned())?;
            std::fs::write(folder.join(format!("{}.csv", table.name)), text)?;
        }
        for figure in &part.figures {
            std::fs::write(folder.join(format!("{}.svg", figure.name)), figure.picture.standalone())?;
        }
    }
    std::fs::write(folder.join(format!("{}.html", experiment.name)), render(experiment))
}

fn render(experiment: &Experiment) -> String {
    let marks = || experiment.parts.iter().flat_map(|part| &part.marks);
    let failed = marks().filter(|mark| mark.holds == Some(false)).count();
    let judged = marks().filter(|mark| mark.holds.is_some()).count();
    let body = html! {
        h1 { (experiment.title) }
        p { (experiment.text) } "\n"
        div class="answer" {
            @if failed == 0 { "All " b { (judged) } " marks hold." }
            @else { b { (failed) } " of " (judged) " marks do not hold." }
        } "\n"
        p class="soft" {
            @if experiment.quick { "This is the short run; times are not judged in it. " }
            (experiment.machine.line()) "."
        } "\n"
        @for part in &experiment.parts { (chapter(part)) }
    };
    page(experiment.title, body)
}

fn chapter(part: &Part) -> Markup {
    let line = |mark: &Mark| {
        let holds = match mark.holds {
            Some(true) => html! { "holds" },
            Some(false) => html! { b { "does not hold" } },
            None => html! { "not judged" },
        };
        vec![html! { (mark.statement) }, html! { (mark.theirs) }, html! { (mark.ours) }, holds]
    };
    html! {
        h2 { (part.title) }
        p { (part.text) } "\n"
        (table(&["mark", "thesis", "here", ""], &part.marks.iter().map(line).collect::<Vec<_>>()))
        div class="charts" { @for shown in &part.figures { (figure(&shown.picture, &shown.caption)) } } "\n"
        @for numbers in &part.tables { (table(&numbers.head, &numbers.rows)) }
    }
}
