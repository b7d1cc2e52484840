//! `grades.csv`: one row per submission, for spreadsheets and learning platforms.

use std::io;

use super::{ClassEntry, escape, view};
use crate::grade::FunctionGrade;

/// Tells Excel that the file is UTF-8, so that it reads names right.
const BYTE_ORDER_MARK: &str = "\u{feff}";

/// The text of `grades.csv`: points of every function first, then their statuses, then the diagnoses.
pub fn render(entries: &[&ClassEntry]) -> io::Result<String> {
    let names = columns(entries);
    let mut writer = ::csv::WriterBuilder::new().terminator(::csv::Terminator::CRLF).from_writer(Vec::new());
    writer.write_record(heading(&names))?;
    for entry in entries {
        writer.write_record(row(entry, &names))?;
    }
    let bytes = writer.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(io::Error::other)?;
    Ok(format!("{BYTE_ORDER_MARK}{text}"))
}

/// The names of all parts that any submission has, in the order in which they first come.
fn columns<'a>(entries: &[&'a ClassEntry]) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for part in entries.iter().flat_map(|entry| view::parts(&entry.grade)) {
        if !names.contains(&part.name.as_str()) {
            names.push(&part.name);
        }
    }
    names
}

fn heading(names: &[&str]) -> Vec<String> {
    let mut cells: Vec<String> = ["submission", "student", "score", "max_score"].map(str::to_owned).to_vec();
    cells.extend(names.iter().map(|name| escape::cell(name)));
    cells.extend(names.iter().map(|name| escape::cell(&format!("{name} status"))));
    cells.extend(["diagnoses", "worst_error", "run_time_s", "seconds"].map(str::to_owned));
    cells
}

fn row(entry: &ClassEntry, names: &[&str]) -> Vec<String> {
    let grade = &entry.grade;
    let part = |name: &str| view::parts(grade).find(|part| part.name == name);
    let mut cells = vec![escape::cell(&grade.submission), escape::cell(&entry.student)];
    cells.extend([number(Some(grade.score)), number(Some(grade.max_score))]);
    cells.extend(names.iter().map(|name| number(part(name).map(|part| part.score))));
    cells.extend(names.iter().map(|name| part(name).map_or(String::new(), |part| view::key(part.status).to_owned())));
    cells.push(escape::cell(&diagnoses(view::parts(grade))));
    cells.extend([number(view::worst_error(grade)), number(view::total_seconds(grade).0), number(Some(grade.seconds))]);
    cells
}

fn diagnoses<'a>(parts: impl Iterator<Item = &'a FunctionGrade>) -> String {
    let named = parts.filter_map(|part| part.diagnosis.as_ref().map(|diagnosis| format!("{}: {diagnosis}", part.name)));
    named.collect::<Vec<_>>().join("; ")
}

/// An empty cell where there is no figure. Small figures keep their digits.
fn number(figure: Option<f64>) -> String {
    match figure.filter(|figure| figure.is_finite()) {
        Some(figure) if figure.abs() >= 1e-3 || figure == 0.0 => view::rounded(figure).to_string(),
        Some(figure) => format!("{figure:e}"),
        None => String::new(),
    }
}
