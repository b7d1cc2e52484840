//! Parts of a page: statements that must be true, tables, pictures, with a paragraph about them; and the files of a page: a table for each table,
//! a picture for each picture, a page for readers.

use std::io;
use std::path::Path;

use fem_chart::page::{details, figure, page, table};
use fem_chart::{Chart, Picture};
use maud::{Markup, html};
use serde::{Deserialize, Serialize};

use super::Finished;
use crate::machine::Machine;

/// A statement that must be true of an outcome.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// The statement.
    pub statement: String,
    /// The figure of a thesis or another source; empty where it has none.
    pub theirs: String,
    /// Our figure.
    pub ours: String,
    /// True if the statement holds; `None` where a short run cannot tell.
    pub holds: Option<bool>,
}

impl Mark {
    /// A mark without a figure of another source.
    pub fn new(statement: impl Into<String>, ours: impl Into<String>, holds: bool) -> Self {
        Self { statement: statement.into(), theirs: String::new(), ours: ours.into(), holds: Some(holds) }
    }

    /// A mark of a number that is at most its bound; NaN is not.
    pub fn at_most(statement: impl Into<String>, ours: f64, bound: f64) -> Self {
        Self::new(statement, format!("{ours:.1e}"), ours <= bound)
    }

    /// Adds the figure of the thesis.
    pub fn beside(self, theirs: impl Into<String>) -> Self {
        Self { theirs: theirs.into(), ..self }
    }

    /// Not judged if the run is too short for it.
    pub fn unless(self, is_short: bool) -> Self {
        Self { holds: self.holds.filter(|_| !is_short), ..self }
    }

    /// Whether it holds, in words.
    pub fn verdict(&self) -> &'static str {
        match self.holds {
            Some(true) => "holds",
            Some(false) => "does not hold",
            None => "not judged",
        }
    }
}

/// Cells with a name for each column. A name that begins with `>` aligns its column to the right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Name of the file, without its ending.
    pub name: String,
    /// Names of the columns, with units.
    pub head: Vec<String>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<String>>,
}

/// A column: its name, and its cell of a row.
pub type Column<'a, Row> = (&'a str, &'a dyn Fn(&Row) -> String);

impl Table {
    /// A table of rows that are written already, with the names of its columns between bars, such as `law | >E (Pa)`.
    pub fn new(name: impl Into<String>, head: &str, rows: Vec<Vec<String>>) -> Self {
        Self { name: name.into(), head: head.split(" | ").map(str::to_owned).collect(), rows }
    }

    /// A table with the cells of these columns.
    pub fn of<Row>(name: impl Into<String>, rows: &[Row], columns: &[Column<Row>]) -> Self {
        let head = columns.iter().map(|(name, _)| *name).collect();
        Self::of_cells(name.into(), head, rows.len(), &|row, column| (columns[column].1)(&rows[row]))
    }

    fn of_cells(name: String, head: Vec<&str>, rows: usize, cell: &dyn Fn(usize, usize) -> String) -> Self {
        let row = |row: usize| (0..head.len()).map(|column| cell(row, column)).collect();
        Self { name, rows: (0..rows).map(row).collect(), head: head.into_iter().map(str::to_owned).collect() }
    }

    /// The text of its file.
    pub fn csv(&self) -> Result<String, csv::Error> {
        let head: Vec<&str> = self.head.iter().map(|name| name.trim_start_matches('>')).collect();
        csv_text(&head, self.rows.iter().cloned())
    }

    /// The table for a page.
    pub fn html(&self) -> Markup {
        table(&self.head.iter().map(String::as_str).collect::<Vec<_>>(), &self.rows)
    }
}

/// A picture with its caption.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Figure {
    /// Name of the file, without its ending.
    pub name: String,
    /// The picture.
    pub picture: Picture,
    /// The caption.
    pub caption: String,
}

impl Figure {
    /// A picture with its caption.
    pub fn new(name: impl Into<String>, picture: Picture, caption: impl Into<String>) -> Self {
        Self { name: name.into(), picture, caption: caption.into() }
    }
}

/// A part of a page.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Part {
    /// Its name as an argument of the program.
    pub name: String,
    /// Its title.
    pub title: String,
    /// A paragraph: the setting, the thesis' figure, the mistake behind it.
    pub text: String,
    /// Statements that must be true of it.
    pub marks: Vec<Mark>,
    /// Its numbers.
    pub tables: Vec<Table>,
    /// Its pictures.
    pub figures: Vec<Figure>,
}

impl Part {
    /// A part with its paragraph. The list that it stands in gives it a name and a title.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// The same with its name and title.
    pub fn titled(self, name: &str, title: &str) -> Self {
        Self { name: name.to_owned(), title: title.to_owned(), ..self }
    }

    /// Adds statements.
    pub fn marks(mut self, marks: impl IntoIterator<Item = Mark>) -> Self {
        self.marks.extend(marks);
        self
    }

    /// Adds tables.
    pub fn tables(mut self, tables: impl IntoIterator<Item = Table>) -> Self {
        self.tables.extend(tables);
        self
    }

    /// Adds a chart with its caption.
    pub fn chart(self, name: impl Into<String>, chart: &Chart, caption: impl Into<String>) -> Self {
        self.figures([Figure::new(name, chart.draw(), caption)])
    }

    /// Adds pictures.
    pub fn figures(mut self, figures: impl IntoIterator<Item = Figure>) -> Self {
        self.figures.extend(figures);
        self
    }

    /// A part whose run has failed.
    pub fn failed(problem: impl ToString) -> Self {
        Self::new("").marks([Mark::new("the part runs to its end", problem.to_string(), false)])
    }

    /// Returns true if no mark fails.
    pub fn passes(&self) -> bool {
        self.marks.iter().all(|mark| mark.holds != Some(false))
    }
}

/// A page of several parts, with the machine that they ran on.
#[derive(Clone, Debug)]
pub struct Page<'a> {
    /// Name of the file, without its ending.
    pub name: &'a str,
    /// Its title.
    pub title: &'a str,
    /// Its first paragraph.
    pub text: &'a str,
    /// The machine and the program.
    pub machine: Machine,
    /// The runs were shortened.
    pub quick: bool,
    /// Its parts.
    pub parts: Vec<Part>,
}

impl Page<'_> {
    /// All statements, each with its part.
    pub fn marks(&self) -> impl Iterator<Item = (&Part, &Mark)> {
        self.parts.iter().flat_map(|part| part.marks.iter().map(move |mark| (part, mark)))
    }

    /// The page as the end of a study: a line for each statement.
    pub fn finished(&self) -> Finished {
        let line = |(part, mark): (&Part, &Mark)| {
            let verdict = if mark.holds == Some(false) { "DOES NOT HOLD" } else { mark.verdict() };
            let theirs = if mark.theirs.is_empty() { String::new() } else { format!(" (published: {})", mark.theirs) };
            let separator = if mark.ours.is_empty() { "" } else { ": " };
            format!("{:9} {verdict}: {}{separator}{}{theirs}", part.name, mark.statement, mark.ours)
        };
        let failed = self.marks().filter(|(_, mark)| mark.holds == Some(false)).count();
        let failed = (failed > 0).then(|| format!("{failed} marks do not hold"));
        Finished { lines: self.marks().map(line).collect(), failed }
    }
}

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

/// A head and rows of the same length as the text of a CSV file (RFC 4180).
pub fn csv_text<I>(head: &[&str], rows: impl IntoIterator<Item = I>) -> Result<String, csv::Error>
where
    I: IntoIterator<Item = String>,
{
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(head)?;
    for row in rows {
        writer.write_record(row.into_iter().map(String::into_bytes))?;
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::csv_text;

    #[test]
    fn cells_with_commas_and_quotes_are_quoted() {
        let row = ["say \"no\"", "plain", ""].map(str::to_owned);
        assert_eq!(csv_text(&["a,b", "c", "d"], [row]).unwrap(), "\"a,b\",c,d\n\"say \"\"no\"\"\",plain,\n");
    }
}
