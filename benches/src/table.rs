//! The table of the engine and its peers, as Markdown and as JSON.

use std::path::Path;

use fem_study::machine::Machine;
use serde::Serialize;

use crate::end::End;
use crate::race::Time;

/// One peer on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub scene: String,
    pub nodes: usize,
    pub steps: usize,
    pub peer: String,
    pub peer_threads: usize,
    /// The peer's time.
    pub theirs: Time,
    /// The engine's, with one thread.
    pub ours_one: Time,
    /// The engine's, with all threads.
    pub ours_all: Time,
    /// Largest difference of a coordinate at the end, m.
    pub difference: f64,
    /// Largest allowed difference, m.
    pub allowed: f64,
}

impl Row {
    /// Ratio of processor times, for a peer with one thread.
    fn ratio_by_one_thread(&self) -> Option<f64> {
        (self.peer_threads == 1).then(|| self.theirs.cpu / self.ours_one.cpu)
    }

    /// Ratio of wall-clock times.
    fn ratio_by_all_threads(&self) -> f64 {
        self.theirs.wall / self.ours_all.wall
    }

    /// The message if the answers differ too much or are not finite.
    pub fn disagreement(&self) -> Option<String> {
        let agrees = self.difference <= self.allowed;
        let Self { scene, peer, difference, allowed, .. } = self;
        (!agrees).then(|| format!("{scene}, {peer}: answers are {difference:.2e} m apart; {allowed:.2e} m are allowed"))
    }
}

/// Prints Markdown.
pub fn print(machine: &Machine, rows: &[Row]) {
    println!("{}\n", machine.line());
    println!(
        "Milliseconds per step, wall (processor); medians of runs in turn. Ratios: processor times with one thread each, and wall times against the engine with all threads.\n"
    );
    println!(
        "| scene | nodes | peer | threads | peer | engine, one thread | engine, all threads | ratio, one thread | ratio, all threads | difference of answers |"
    );
    println!("|---|---:|---|---:|---:|---:|---:|---:|---:|---:|");
    for row in rows {
        let milliseconds = |time: Time| format!("{:.3} ({:.3})", 1e3 * time.wall, 1e3 * time.cpu);
        println!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {:.1} | {:.1e} m |",
            row.scene,
            row.nodes,
            row.peer,
            row.peer_threads,
            milliseconds(row.theirs),
            milliseconds(row.ours_one),
            milliseconds(row.ours_all),
            row.ratio_by_one_thread().map_or("–".to_owned(), |ratio| format!("{ratio:.1}")),
            row.ratio_by_all_threads(),
            row.difference
        );
    }
}

/// Writes the table as JSON.
pub fn write(path: &Path, machine: &Machine, rows: &[Row]) -> Result<(), End> {
    #[derive(Serialize)]
    struct Table<'a> {
        machine: &'a Machine,
        rows: &'a [Row],
    }
    let text = serde_json::to_string_pretty(&Table { machine, rows }).map_err(End::wrong)?;
    std::fs::write(path, text + "\n").map_err(|error| End::unusable(format!("{}: {error}", path.display())))
}
