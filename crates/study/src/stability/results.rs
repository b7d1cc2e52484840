//! The results of a study: rows, maps and their counts.

use std::collections::BTreeSet;
use std::path::Path;

use serde::Serialize;

use super::case::{CaseRow, Map};
use crate::machine::Machine;
use crate::study::{Column, Finished, Found, Table};

/// The results of a study.
#[derive(Clone, Debug, Serialize)]
pub struct Results {
    /// The short study.
    pub quick: bool,
    /// Machine and date.
    pub machine: Machine,
    /// Wall-clock time of the study, s; of joined shards, that of all cases.
    pub seconds: f64,
    /// Numbers of rows.
    pub counts: Counts,
    /// Rows in the order of the families.
    pub rows: Vec<CaseRow>,
    /// Maps in the order of the integrators.
    pub maps: Vec<Map>,
}

/// Numbers of rows and runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Rows.
    pub rows: usize,
    /// Rows with the expected outcome.
    pub pass: usize,
    /// Rows with random initial states.
    pub seeded_rows: usize,
    /// Different seeds.
    pub seeds: usize,
    /// Runs of all maps.
    pub map_cells: usize,
}

impl Results {
    /// Counts rows and maps.
    pub fn new(quick: bool, Found { mut rows, machine, seconds }: Found<CaseRow>) -> Self {
        let maps: Vec<Map> = rows.iter_mut().filter_map(|row| row.map.take()).collect();
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

    /// Returns true if every row has the expected outcome.
    pub fn passes(&self) -> bool {
        self.counts.pass == self.counts.rows
    }

    /// The end of the study.
    pub fn finished(&self, out: &Path) -> Finished {
        let Counts { rows, pass, seeded_rows, seeds, map_cells } = self.counts;
        let told = format!(
            "{pass} of {rows} cases as expected ({seeded_rows} of them from random states with {seeds} seeds; {map_cells} more runs in \
             maps), {:.0} s",
            self.seconds
        );
        let failed = (!self.passes()).then(|| format!("{} cases have an unexpected outcome", rows - pass));
        Finished { lines: vec![told, out.join("stability.html").display().to_string()], failed }
    }

    /// `stability.csv`: a head and a line for each row.
    pub fn csv(&self) -> Result<String, csv::Error> {
        let columns: [Column<CaseRow>; 12] = [
            ("family", &|row| row.family.clone()),
            ("case", &|row| row.case.clone()),
            ("parameters", &|row| row.parameters.clone()),
            ("integrator", &|row| row.integrator.clone()),
            ("material", &|row| row.material.clone()),
            ("seed", &|row| row.seed.map_or(String::new(), |seed| seed.to_string())),
            ("expected", &|row| row.expected.to_string()),
            ("outcome", &|row| row.outcome.to_string()),
            // Other machines reproduce four digits.
            ("margin", &|row| row.margin.map_or(String::new(), |margin| format!("{margin:.3e}"))),
            ("pass", &|row| row.pass.to_string()),
            ("margin_is", &|row| row.margin_is.clone()),
            ("note", &|row| row.note.clone()),
        ];
        Table::of("stability", &self.rows, &columns).csv()
    }
}
