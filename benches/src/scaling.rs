//! Time and memory over the size of the body.

use std::path::Path;

use fem_study::machine::{self, Machine};
use fem_study::runs::convergence_order::fit;

use crate::cli::{RunArguments, ScalingArguments};
use crate::end::End;
use crate::race::{Contestant, Time, race};
use crate::run::{self, Measurement};

/// Cells per metre of beams of 1 225 to 60 625 nodes.
const CELLS: [usize; 7] = [6, 8, 10, 13, 16, 20, 24];

/// Times boxes of increasing size in turn, and prints a table and the fitted exponents.
pub fn run(arguments: &ScalingArguments) -> Result<(), End> {
    let sizes = &arguments.sizes;
    let cells = if sizes.cells.is_empty() { CELLS.to_vec() } else { sizes.cells.clone() };
    let beams: Vec<RunArguments> = cells.iter().map(|&cells| beam(arguments, cells)).collect();
    let runs =
        beams.iter().map(|beam| run::apart(beam, machine::threads())).collect::<Result<Vec<Measurement>, End>>()?;
    let contestants: Vec<Contestant> =
        beams.iter().flat_map(|beam| [run::timed(beam, 1), run::timed(beam, machine::threads())]).collect();
    let times = race(sizes.rounds, &contestants)?;
    print(&cells, &runs, &times);
    Ok(())
}

fn beam(arguments: &ScalingArguments, cells: usize) -> RunArguments {
    RunArguments {
        scene: arguments.scene.clone(),
        steps: Some(arguments.sizes.steps),
        cells: Some(cells),
        solver: arguments.solver,
        overrides: Vec::new(),
        data: arguments.sizes.data.clone(),
    }
}

/// Times of a size, s.
struct Row {
    nodes: f64,
    /// A step by one thread, and by all.
    one: f64,
    all: f64,
    /// Set-up and all steps by one thread.
    whole: f64,
}

/// `times` contains two values for each run: with one thread, and with all threads.
fn print(cells: &[usize], runs: &[Measurement], times: &[Time]) {
    println!("{}\n", Machine::this(Path::new(".")).line());
    println!(
        "| cells per metre | nodes | one thread, ms per step (processor) | all threads, ms per step | Newton iterations per step | set-up, s | peak memory, MiB |"
    );
    println!("|---:|---:|---:|---:|---:|---:|---:|");
    let mut rows = Vec::new();
    for ((cells, run), times) in cells.iter().zip(runs).zip(times.chunks(2)) {
        let memory =
            run.peak_memory_bytes.map_or("unknown".to_owned(), |bytes| format!("{:.0}", bytes as f64 / 1048576.0));
        let (one, all) = (times[0].cpu, times[1].wall);
        println!(
            "| {cells} | {} | {:.2} | {:.2} | {:.2} | {:.2} | {memory} |",
            run.nodes,
            1e3 * one,
            1e3 * all,
            run.newton_per_step,
            run.seconds_setup
        );
        rows.push(Row { nodes: run.nodes as f64, one, all, whole: run.seconds_setup + run.steps as f64 * one });
    }
    let exponent = |time: fn(&Row) -> f64| {
        let points: Vec<(f64, f64)> = rows.iter().map(|row| (row.nodes, time(row))).collect();
        fit(&points).map_or("unknown: give two sizes".to_owned(), |fit| format!("{:.3}", fit.value))
    };
    let (one, all, whole) = (exponent(|row| row.one), exponent(|row| row.all), exponent(|row| row.whole));
    println!(
        "\nExponent of a step, one thread: {one}; all threads: {all}. Of set-up and all steps, one thread: {whole}."
    );
}
