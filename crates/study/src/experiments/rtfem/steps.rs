//! The parts of a step, as the thesis divides it: force assembly, right-hand side, solve.

use std::time::Instant;

use super::setting::{LAWS, Setting, one_thread};
use super::torus::Torus;
use crate::study::Table;

/// Elements, and the times of the thesis for force assembly, right-hand side and solve, ms.
const THEIRS: [(usize, [f64; 3]); 3] = [(1119, [4.0, 0.20, 4.0]), (2000, [5.0, 0.22, 5.0]), (5392, [16.0, 0.66, 15.0])];

/// The groups, with the parts of the engine that belong to each.
const GROUPS: [(&str, &[&str]); 3] = [
    ("force assembly", &["forces", "line_search", "stiffness", "projection"]),
    ("right-hand side", &["mass", "dead_load", "damping", "prescribed"]),
    ("solve", &["solver", "preconditioner"]),
];

/// A row for each law on one thread.
///
/// # Errors
/// A step that fails.
pub fn share(torus: &Torus, wanted: usize, count: usize) -> Result<Vec<Vec<String>>, String> {
    LAWS.iter().map(|law| one_thread()?.install(|| row(torus, wanted, law, count))).collect()
}

fn row(torus: &Torus, wanted: usize, law: &str, count: usize) -> Result<Vec<String>, String> {
    let mut simulation = Setting::of_law(law).torus(&torus.mesh)?;
    simulation.step().map_err(|failure| failure.to_string())?; // factorises
    let seconds = |parts: &[fem_model::simulation::Part], names: &[&str]| -> f64 {
        parts.iter().filter(|part| names.contains(&part.name)).map(|part| part.seconds).sum()
    };
    let before = simulation.parts();
    let begun = Instant::now();
    for _ in 0..count {
        simulation.step().map_err(|failure| failure.to_string())?;
    }
    let total = begun.elapsed().as_secs_f64();
    let after = simulation.parts();
    let spent = GROUPS.map(|(_, names)| seconds(&after, names) - seconds(&before, names));
    let rest = total - spent.iter().sum::<f64>();
    let theirs = THEIRS.iter().find(|theirs| theirs.0 == wanted).map(|theirs| theirs.1);
    let mut row = vec![torus.mesh.elements.len().to_string(), law.to_owned()];
    for (number, spent) in spent.into_iter().enumerate() {
        row.push(theirs.map_or(String::new(), |theirs| format!("{}", theirs[number])));
        row.push(format!("{:.4}", 1e3 * spent / count as f64));
    }
    row.push(format!("{:.4}", 1e3 * rest / count as f64));
    Ok(row)
}

/// The table of these rows.
pub fn parts_table(rows: Vec<Vec<String>>) -> Table {
    let head = [
        ">elements",
        "law",
        ">force assembly, thesis (ms)",
        ">here (ms)",
        ">right-hand side, thesis (ms)",
        ">here (ms)",
        ">solve, thesis (ms)",
        ">here (ms)",
        ">the rest (ms)",
    ];
    Table::new("rtfem-parts", &head, rows)
}
