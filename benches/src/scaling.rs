//! Time and memory over the size of the body.

use std::path::Path;

use fem_study::machine::{self, Machine};

use crate::cli::{RunArguments, ScalingArguments};
use crate::end::End;
use crate::race::{Contestant, Time, race};
use crate::run::{self, Measurement};

/// Cells per metre of beams of 1 225 to 60 625 nodes.
const CELLS: [usize; 7] = [6, 8, 10, 13, 16, 20, 24];

/// Times beams of increasing size in turn, and prints a table and the fitted exponents.
pub fn run(arguments: &ScalingArguments) -> Result<(), End> {
    let sizes = &arguments.sizes;
    let cells = if sizes.cells.is_empty() { CELLS.to_vec() } else { sizes.cells.clone() };
    let beams: Vec<RunArguments> = cells.iter().map(|&cells| beam(arguments, cells)).collect();
    let runs =
        beams.iter().map(|beam| run::apart(beam, machine::threads())).collect::<Result<Vec<Measurement>, End>>()?;
    let timed = |beam, threads| -> Contestant {
        Box::new(move || run::apart(beam, threads).map(|run| Time { wall: run.wall_per_step, cpu: run.cpu_per_step }))
    };
    let contestants: Vec<Contestant> =
        beams.iter().flat_map(|beam| [timed(beam, 1), timed(beam, machine::threads())]).collect();
    let times = race(sizes.rounds, &contestants)?;
    print(&cells, &runs, &times);
    Ok(())
}

fn beam(arguments: &ScalingArguments, cells: usize) -> RunArguments {
    RunArguments {
        scene: "beam".to_owned(),
        steps: Some(arguments.sizes.steps),
        cells: Some(cells),
        solver: arguments.solver,
        data: arguments.sizes.data.clone(),
    }
}

/// `times` contains two values for each run: with one thread, and with all threads.
fn print(cells: &[usize], runs: &[Measurement], times: &[Time]) {
    println!("{}\n", Machine::this(Path::new(".")).line());
    println!(
        "| cells per metre | nodes | one thread, ms per step (processor) | all threads, ms per step | Newton iterations per step | peak memory, MiB |"
    );
    println!("|---:|---:|---:|---:|---:|---:|");
    let mut rows = Vec::new();
    for ((cells, run), times) in cells.iter().zip(runs).zip(times.chunks(2)) {
        let memory =
            run.peak_memory_bytes.map_or("unknown".to_owned(), |bytes| format!("{:.0}", bytes as f64 / 1048576.0));
        let (one, all) = (times[0].cpu, times[1].wall);
        println!(
            "| {cells} | {} | {:.2} | {:.2} | {:.2} | {memory} |",
            run.nodes,
            1e3 * one,
            1e3 * all,
            run.newton_per_step
        );
        rows.push((run.nodes as f64, one, all));
    }
    let exponent = |time: fn(&(f64, f64, f64)) -> f64| {
        let points: Vec<(f64, f64)> = rows.iter().map(|row| (row.0, time(row))).collect();
        exponent(&points).map_or("unknown: give two sizes".to_owned(), |exponent| format!("{exponent:.3}"))
    };
    println!("\nExponent, one thread: {}; all threads: {}.", exponent(|row| row.1), exponent(|row| row.2));
}

/// Slope of the line through (log x, log y) by least squares; `None` for fewer than two sizes.
fn exponent(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / logs.len() as f64;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let spread: f64 = logs.iter().map(|point| (point.0 - x).powi(2)).sum();
    let slope = logs.iter().map(|point| (point.0 - x) * (point.1 - y)).sum::<f64>() / spread;
    (spread > 0.0).then_some(slope)
}

#[cfg(test)]
mod tests {
    use super::exponent;

    #[test]
    fn the_exponent_of_a_power_is_found_and_one_size_has_none() {
        let power: Vec<(f64, f64)> = [1.0, 10.0, 50.0].map(|x: f64| (x, 3.0 * x.powf(1.25))).to_vec();
        assert!((exponent(&power).unwrap() - 1.25).abs() < 1e-12);
        assert_eq!(exponent(&power[..1]), None);
    }
}
