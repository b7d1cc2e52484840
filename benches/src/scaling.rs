//! How time and memory grow with the body.

use crate::cli::{RunArguments, SizesArguments};
use crate::end::End;
use crate::machine::{self, Machine};
use crate::race::{Contestant, Time, race};
use crate::run::{self, Run};

/// Cells per metre of beams of 1 225 to 60 625 nodes.
const CELLS: [usize; 7] = [6, 8, 10, 13, 16, 20, 24];

/// Times beams of growing size and prints a table and the exponents that fit it.
pub fn run(arguments: &SizesArguments) -> Result<(), End> {
    let cells = if arguments.cells.is_empty() { CELLS.to_vec() } else { arguments.cells.clone() };
    println!("{}\n", Machine::this().line());
    println!(
        "| cells per metre | nodes | one thread, ms per step (processor) | all threads, ms per step | Newton iterations per step | peak memory, MiB |"
    );
    println!("|---:|---:|---:|---:|---:|---:|");
    let mut rows = Vec::new();
    for cells in cells {
        let (run, one, all) = size(arguments, cells)?;
        let memory =
            run.peak_memory_bytes.map_or("unknown".to_owned(), |bytes| format!("{:.0}", bytes as f64 / 1048576.0));
        println!(
            "| {cells} | {} | {:.2} | {:.2} | {:.2} | {memory} |",
            run.nodes,
            1e3 * one.cpu,
            1e3 * all.wall,
            run.newton_per_step
        );
        rows.push((run.nodes as f64, one.cpu, all.wall));
    }
    let exponent = |time: fn(&(f64, f64, f64)) -> f64| {
        let points: Vec<(f64, f64)> = rows.iter().map(|row| (row.0, time(row))).collect();
        exponent(&points).map_or("unknown: give two sizes".to_owned(), |exponent| format!("{exponent:.3}"))
    };
    println!("\nExponent, one thread: {}; all threads: {}.", exponent(|row| row.1), exponent(|row| row.2));
    Ok(())
}

/// One run, and its times by one thread and by all.
fn size(arguments: &SizesArguments, cells: usize) -> Result<(Run, Time, Time), End> {
    let beam = RunArguments {
        scene: "beam".to_owned(),
        steps: Some(arguments.steps),
        cells: Some(cells),
        solver: None,
        data: arguments.data.clone(),
    };
    let timed = |threads| -> Contestant {
        let beam = &beam;
        Box::new(move || run::apart(beam, threads).map(|run| Time { wall: run.wall_per_step, cpu: run.cpu_per_step }))
    };
    let all = machine::threads();
    let run = run::apart(&beam, all)?;
    let times = race(arguments.rounds, &[timed(1), timed(all)])?;
    Ok((run, times[0], times[1]))
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
