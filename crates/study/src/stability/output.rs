//! The rows as files: a table for programs that read columns, one for those that read JSON, and a page for people.

use std::collections::BTreeSet;
use std::io;
use std::path::Path;

use serde::Serialize;

use super::case::Row;
use super::map::Map;
use super::page;
use crate::csv_table::csv_text;
use crate::machine::Machine;

/// All that a study has found.
#[derive(Clone, Debug, Serialize)]
pub struct Table {
    /// Whether it is the reduced one.
    pub quick: bool,
    /// What it ran on, and when.
    pub machine: Machine,
    /// Wall-clock time of all of it, s.
    pub seconds: f64,
    /// Numbers of rows.
    pub counts: Counts,
    /// In the order of the chapters.
    pub rows: Vec<Row>,
    /// One for each method that moves.
    pub maps: Vec<Map>,
}

/// How many there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Rows.
    pub rows: usize,
    /// Rows that are as expected.
    pub pass: usize,
    /// Rows that start from random numbers.
    pub seeded_rows: usize,
    /// Different seeds among them.
    pub seeds: usize,
    /// Pairs of all maps.
    pub map_cells: usize,
}

impl Table {
    /// Of these rows and maps.
    pub fn new(quick: bool, machine: Machine, seconds: f64, rows: Vec<Row>, maps: Vec<Map>) -> Self {
        let seeds: Vec<u64> = rows.iter().filter_map(|row| row.seed).collect();
        let counts = Counts {
            rows: rows.len(),
            pass: rows.iter().filter(|row| row.pass).count(),
            seeded_rows: seeds.len(),
            seeds: seeds.iter().collect::<BTreeSet<_>>().len(),
            map_cells: maps.iter().map(|map| map.cells.len()).sum(),
        };
        Self { quick, machine, seconds, counts, rows, maps }
    }

    /// Whether every row is as expected.
    pub fn passes(&self) -> bool {
        self.counts.pass == self.counts.rows
    }

    /// A line for each row, with a head.
    pub fn csv(&self) -> Result<String, csv::Error> {
        csv_text(&COLUMNS, self.rows.iter().map(cells))
    }
}

const COLUMNS: [&str; 12] = [
    "family",
    "case",
    "parameters",
    "integrator",
    "material",
    "seed",
    "expected",
    "outcome",
    "margin",
    "pass",
    "margin_is",
    "note",
];

fn cells(row: &Row) -> Vec<String> {
    let seed = row.seed.map_or(String::new(), |seed| seed.to_string());
    // Four digits say all that another machine will say too.
    let margin = row.margin.map_or(String::new(), |margin| format!("{margin:.3e}"));
    // A message of several lines becomes one, so that a row is a line.
    let note = row.note.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    let cells = [
        row.family,
        &row.case,
        &row.parameters,
        &row.integrator,
        &row.material,
        &seed,
        row.expected.name(),
        row.outcome.name(),
        &margin,
        if row.pass { "true" } else { "false" },
        row.margin_is,
        &note,
    ];
    cells.map(str::to_owned).to_vec()
}

/// Writes `stability.csv`, `stability.json` and `stability.html` into a folder, and a picture of each map.
pub fn write(table: &Table, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("stability.csv"), table.csv()?)?;
    std::fs::write(folder.join("stability.json"), serde_json::to_string_pretty(table)? + "\n")?;
    for map in &table.maps {
        let picture = page::picture(map).standalone();
        std::fs::write(folder.join(format!("stability-{}.svg", map.integrator)), picture)?;
    }
    std::fs::write(folder.join("stability.html"), page::render(table))
}
