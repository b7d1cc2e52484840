//! The files of a page: a table for each table, a picture for each picture, a page for readers.

use std::io;
use std::path::Path;

use fem_chart::page::{details, figure, page, table};
use maud::{Markup, html};

use super::{Mark, Page, Part};

/// Rows of a table that a page shows at once; a longer one is opened by the reader.
const LONG: usize = 40;

/// Writes the page, the tables (`.csv`) and the pictures (`.svg`) into a folder.
pub fn write(of: &Page, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    for part in &of.parts {
        for table in &part.tables {
            std::fs::write(folder.join(format!("{}.csv", table.name)), table.csv()?)?;
        }
        for figure in &part.figures {
            std::fs::write(folder.join(format!("{}.svg", figure.name)), figure.picture.standalone())?;
        }
    }
    std::fs::write(folder.join(format!("{}.html", of.name)), render(of))
}

fn render(of: &Page) -> String {
    let failed = of.marks().filter(|(_, mark)| mark.holds == Some(false)).count();
    let judged = of.marks().filter(|(_, mark)| mark.holds.is_some()).count();
    let body = html! {
        h1 { (of.title) }
        p { (of.text) } "\n"
        div class="answer" {
            @if failed == 0 { "All " b { (judged) } " marks hold." }
            @else { b { (failed) } " of " (judged) " marks do not hold." }
        } "\n"
        p class="soft" {
            @if of.quick { "This is the short run; times are not judged in it. " }
            (of.machine.line()) "."
        } "\n"
        @for part in &of.parts { (chapter(part)) }
    };
    page(of.title, body)
}

fn chapter(part: &Part) -> Markup {
    let line = |mark: &Mark| {
        let holds = html! { @if mark.holds == Some(false) { b { (mark.verdict()) } } @else { (mark.verdict()) } };
        let wrapped = |text: &str| html! { div class="wide" { (text) } };
        vec![wrapped(&mark.statement), html! { (mark.theirs) }, wrapped(&mark.ours), holds]
    };
    html! {
        h2 { (part.title) }
        p { (part.text) } "\n"
        (table(&["mark", "source", "here", ""], &part.marks.iter().map(line).collect::<Vec<_>>()))
        div class="charts" { @for shown in &part.figures { (figure(&shown.picture, &shown.caption)) } } "\n"
        @for numbers in &part.tables {
            @if numbers.rows.len() > LONG { (details(&format!("{}.csv, {} rows", numbers.name, numbers.rows.len()), numbers.html())) }
            @else { (numbers.html()) }
        }
    }
}
