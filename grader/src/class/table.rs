//! `grades.csv` and `errors.csv`.

use std::io;

use super::{Entry, Outcome};

/// One row per submission that counts. Without a grade the cells of the scores are empty and `note` tells why.
pub fn grades(entries: &[Entry]) -> io::Result<Vec<u8>> {
    let mut names: Vec<&str> = Vec::new();
    for entry in entries {
        if let Outcome::Graded(grade, _) = &entry.outcome
            && grade.functions.len() > names.len()
        {
            names = grade.functions.iter().map(|function| function.name.as_str()).collect();
        }
    }
    let mut table = csv::Writer::from_writer(Vec::new());
    let header = ["student", "submission", "score", "max_score", "note"];
    table.write_record(header.iter().chain(&names))?;
    for entry in entries.iter().filter(|entry| !matches!(entry.outcome, Outcome::Older { .. })) {
        table.write_record(row(entry, &names))?;
    }
    table.into_inner().map_err(|error| error.into_error())
}

fn row(entry: &Entry, names: &[&str]) -> Vec<String> {
    let mut row = vec![entry.student.clone(), entry.submission.clone()];
    match &entry.outcome {
        Outcome::Graded(grade, _) => {
            row.extend([grade.score.to_string(), grade.max_score.to_string(), String::new()]);
            row.extend(names.iter().map(|name| {
                let function = grade.functions.iter().find(|function| function.name == *name);
                function.map_or(String::new(), |function| function.score.to_string())
            }));
        }
        Outcome::NotGraded(reason) => row.extend([String::new(), String::new(), format!("not graded: {reason}")]),
        Outcome::Waiting => row.extend([String::new(), String::new(), "not graded yet".into()]),
        Outcome::Older { newer } => row.extend([String::new(), String::new(), format!("{newer} is newer")]),
    }
    row.resize(5 + names.len(), String::new());
    row
}

/// One row per submission that could not be graded.
pub fn errors(entries: &[Entry]) -> io::Result<Vec<u8>> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(["student", "submission", "reason"])?;
    for entry in entries {
        if let Outcome::NotGraded(reason) = &entry.outcome {
            table.write_record([&entry.student, &entry.submission, reason])?;
        }
    }
    table.into_inner().map_err(|error| error.into_error())
}
