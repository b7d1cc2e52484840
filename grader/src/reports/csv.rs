//! `grades.csv`, for spreadsheets and learning platforms, and `errors.csv`, what could not be graded.

use std::io;

use super::rows::Row;
use super::{escape, view};
use crate::class::Outcome;
use crate::grade::{FunctionGrade, Grade};

/// Tells Excel that the file is UTF-8, so that it reads names right.
const BYTE_ORDER_MARK: &str = "\u{feff}";

/// Columns at the start of each row. Without a grade the cells of the scores are empty and `note` gives the reason.
const FIRST: [&str; 5] = ["student", "submission", "score", "max_score", "note"];

/// Columns at the end of each row. `raw_score` is the one before points by hand and the penalty for lateness.
const LAST: [&str; 8] =
    ["diagnoses", "worst_error", "run_time_s", "seconds", "raw_score", "submitted", "days_late", "penalty"];

/// The text of `grades.csv`: points of every function first, then their statuses, then the diagnoses.
pub fn grades(rows: &[Row]) -> io::Result<String> {
    let names = columns(rows);
    text(heading(&names), rows.iter().map(|row| cells(row, &names)))
}

/// The text of `errors.csv`: one row per submission that could not be graded.
pub fn errors(rows: &[Row]) -> io::Result<String> {
    let failed = rows.iter().filter_map(|row| match &row.entry.outcome {
        Outcome::NotGraded(reason) => {
            Some([&row.entry.student, &row.entry.submission, reason].map(|text| escape::cell(text)).to_vec())
        }
        _ => None,
    });
    text(["student", "submission", "reason"].map(str::to_owned).to_vec(), failed)
}

pub(super) fn text(heading: Vec<String>, rows: impl Iterator<Item = Vec<String>>) -> io::Result<String> {
    let mut writer = ::csv::WriterBuilder::new().terminator(::csv::Terminator::CRLF).from_writer(Vec::new());
    writer.write_record(heading)?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(io::Error::other)?;
    Ok(format!("{BYTE_ORDER_MARK}{text}"))
}

/// The names of all parts that any submission has, in the order in which they first come.
fn columns<'a>(rows: &'a [Row]) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for part in rows.iter().filter_map(Row::grade).flat_map(view::parts) {
        if !names.contains(&part.name.as_str()) {
            names.push(&part.name);
        }
    }
    names
}

fn heading(names: &[&str]) -> Vec<String> {
    let mut cells: Vec<String> = FIRST.map(str::to_owned).to_vec();
    cells.extend(names.iter().map(|name| escape::cell(name)));
    cells.extend(names.iter().map(|name| escape::cell(&format!("{name} status"))));
    cells.extend(LAST.map(str::to_owned));
    cells
}

fn cells(row: &Row, names: &[&str]) -> Vec<String> {
    let grade = row.grade();
    let mut cells = vec![escape::cell(&row.entry.student), escape::cell(&row.entry.submission)];
    let (score, max_score) = row.score();
    cells.extend([points(score), points(max_score)]);
    cells.push(escape::cell(&row.notes().join("; ")));
    match grade {
        Some(grade) => cells.extend(figures(grade, names)),
        None => cells.resize(FIRST.len() + 2 * names.len() + LAST.len(), String::new()),
    }
    cells
}

fn figures(grade: &Grade, names: &[&str]) -> Vec<String> {
    let part = |name: &str| view::parts(grade).find(|part| part.name == name);
    let scores = names.iter().map(|name| points(part(name).map(|part| part.score)));
    let status = |name: &&str| part(name).map_or(String::new(), |part| view::key(part.status).to_owned());
    let mut cells: Vec<String> = scores.chain(names.iter().map(status)).collect();
    cells.push(escape::cell(&diagnoses(view::parts(grade))));
    cells.extend([view::worst_error(grade), view::total_seconds(grade).0, Some(grade.seconds)].map(figure));
    let account = grade.account.as_ref();
    cells.push(points(Some(account.map_or(grade.score, |account| account.raw_score))));
    match account.and_then(|account| account.late.as_ref()) {
        Some(late) => {
            cells.extend([late.submitted.clone(), late.days.to_string(), view::rounded(late.penalty).to_string()])
        }
        None => cells.extend([const { String::new() }; 3]),
    }
    cells
}

fn diagnoses<'a>(parts: impl Iterator<Item = &'a FunctionGrade>) -> String {
    let named = parts.filter_map(|part| part.diagnosis.as_ref().map(|diagnosis| format!("{}: {diagnosis}", part.name)));
    named.collect::<Vec<_>>().join("; ")
}

/// Points; an empty cell where there are none.
fn points(points: Option<f64>) -> String {
    points.filter(|points| points.is_finite()).map_or(String::new(), view::points)
}

/// An error or a time with four digits, however small; an empty cell without one.
fn figure(figure: Option<f64>) -> String {
    match figure.filter(|figure| figure.is_finite()) {
        Some(figure) if figure == 0.0 || (1e-3..1e4).contains(&figure) => {
            let digits = if figure == 0.0 { 0 } else { (3 - figure.log10().floor() as i32).max(0) as usize };
            format!("{figure:.digits$}")
        }
        Some(figure) => format!("{figure:.3e}"),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::figure;

    #[test]
    fn figures_keep_four_digits_and_need_no_unit_of_their_own() {
        let cell = |number| figure(Some(number));
        assert_eq!([cell(0.0), cell(1.234_56e-15), cell(9.9999e-4)], ["0", "1.235e-15", "1.000e-3"]);
        assert_eq!([cell(0.001_434_56), cell(12.345_678), cell(123_456.0)], ["0.001435", "12.35", "1.235e5"]);
        assert_eq!([figure(None), cell(f64::NAN), cell(f64::INFINITY)], ["", "", ""]);
    }
}
