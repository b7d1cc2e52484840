//! Changes of points since the previous run: `points.json` keeps those of the last complete run.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Entry, Outcome};

const POINTS: &str = "points.json";

/// Points of one student.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Points {
    pub submission: String,
    pub score: f64,
    pub max_score: f64,
    pub functions: BTreeMap<String, f64>,
}

/// Points of all students that have a grade.
pub type Table = BTreeMap<String, Points>;

/// The points of a student that have changed.
#[derive(Clone, Debug)]
pub struct Change {
    pub student: String,
    pub before: Points,
    pub after: Points,
}

impl Change {
    /// Functions whose points have changed: old and new points; `None` for a function that was not graded.
    pub fn functions(&self) -> Vec<(&str, Option<f64>, Option<f64>)> {
        let (before, after) = (&self.before.functions, &self.after.functions);
        let mut names: Vec<&String> = before.keys().chain(after.keys()).collect();
        names.sort();
        names.dedup();
        let pairs = names.into_iter().map(|name| (name.as_str(), before.get(name).copied(), after.get(name).copied()));
        pairs.filter(|(_, before, after)| before != after).collect()
    }
}

/// The points of a class as it stands.
pub fn table(entries: &[Entry]) -> Table {
    let graded = entries.iter().filter_map(|entry| match &entry.outcome {
        Outcome::Graded(grade, _) => {
            let functions = grade.functions.iter().map(|part| (part.name.clone(), part.score)).collect();
            let (score, max_score) = (grade.score, grade.max_score);
            Some((entry.student.clone(), Points { submission: entry.submission.clone(), score, max_score, functions }))
        }
        _ => None,
    });
    graded.collect()
}

/// The table of the last complete run; empty before the first.
pub fn read(out: &Path) -> Table {
    // If the file cannot be read, no changes are reported, and the grades are still written.
    fs::read(out.join(POINTS)).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
}

/// Keeps a table for the next run.
pub fn write(out: &Path, table: &Table) -> io::Result<()> {
    super::store::replace(&out.join(POINTS), &serde_json::to_vec_pretty(table)?)
}

/// Returns the students whose points have changed. New students are not among them.
pub fn changes(before: &Table, after: &Table) -> Vec<Change> {
    let pairs = after.iter().filter_map(|(student, after)| Some((student, before.get(student)?, after)));
    let changed = pairs.filter(|(_, before, after)| {
        (before.score, before.max_score, &before.functions) != (after.score, after.max_score, &after.functions)
    });
    let change = |(student, before, after): (&String, &Points, &Points)| Change {
        student: student.clone(),
        before: before.clone(),
        after: after.clone(),
    };
    changed.map(change).collect()
}
