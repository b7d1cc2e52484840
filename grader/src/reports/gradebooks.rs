//! `canvas.csv` and `moodle.csv`: the scores of a class in the columns that these systems import.
//!
//! Canvas finds a student by `ID`, `SIS User ID` or `SIS Login ID`, and the assignment by the heading of its column, `TITLE (ID)`; its
//! second row holds the points possible. Moodle asks which columns name the student and which the grade, and wants a grade beside each
//! comment.

use std::io;

use super::csv::text;
use super::rows::Row;
use super::{escape, view};
use crate::class::{Person, Summary};

/// Columns of Canvas before the assignment's.
const CANVAS: [&str; 5] = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"];

/// Columns of Moodle's grading worksheet, without those that it does not read.
const MOODLE: [&str; 7] =
    ["Full name", "ID number", "Username", "Email address", "Grade", "Maximum Grade", "Feedback comments"];

/// The text of `canvas.csv`. A student without a score keeps the one that Canvas has.
pub fn canvas(rows: &[Row], summary: &Summary) -> io::Result<String> {
    let heading = CANVAS.iter().copied().chain([summary.title.as_str()]).map(escape::cell).collect();
    let possible = ["    Points Possible", "", "", "", ""].map(str::to_owned).into_iter();
    let possible = possible.chain([view::points(summary.max_score)]).collect();
    let students = students(rows, summary).into_iter().map(|(person, row)| {
        let name = if person.name.is_empty() { &person.student } else { &person.name };
        // Canvas' own number of a student is known from its gradebook alone; the other two identifiers suffice.
        let cells = [name, &person.canvas, &person.id, &person.login, &person.section].map(|text| escape::cell(text));
        cells.into_iter().chain([score(row)]).collect()
    });
    Ok(text(heading, [possible].into_iter().chain(students))?.trim_start_matches('\u{feff}').to_owned())
}

/// The text of `moodle.csv`.
pub fn moodle(rows: &[Row], summary: &Summary) -> io::Result<String> {
    let heading = MOODLE.map(str::to_owned).to_vec();
    let students = students(rows, summary).into_iter().map(|(person, row)| {
        let name = if person.name.is_empty() { &person.student } else { &person.name };
        let cells = [name, &person.id, &person.login, &person.email].map(|text| escape::cell(text));
        let remarks = row.and_then(Row::grade).map_or(String::new(), |grade| grade.remarks.join("; "));
        cells.into_iter().chain([score(row), view::points(summary.max_score), escape::cell(&remarks)]).collect()
    });
    Ok(text(heading, students)?.trim_start_matches('\u{feff}').to_owned())
}

/// One row for each student: of the roster, and of the submissions beside it.
fn students<'a>(rows: &'a [Row<'a>], summary: &Summary) -> Vec<(Person, Option<&'a Row<'a>>)> {
    let mut people = summary.people.clone();
    for row in rows {
        if !people.iter().any(|person| person.student == row.entry.student) {
            people.push(Person { student: row.entry.student.clone(), ..Person::default() });
        }
    }
    people.sort_by_key(|person| (person.name.to_lowercase(), person.student.to_lowercase()));
    let row_of = |person: &Person| {
        let mut own = rows.iter().filter(|row| row.entry.student == person.student);
        own.clone().find(|row| row.grade().is_some()).or_else(|| own.next())
    };
    people
        .into_iter()
        .map(|person| {
            let row = row_of(&person);
            (person, row)
        })
        .collect()
}

fn score(row: Option<&Row>) -> String {
    row.and_then(|row| row.score().0).map_or(String::new(), view::points)
}
