//! Bodies of increasing size with implicit steps, whose linear systems the device solves.

use fem_study::machine;

use super::{GPU, check_agreement};
use crate::cli::{RunArguments, SizesArguments};
use crate::end::End;
use crate::race::{Contestant, race};
use crate::run;

/// Cells per metre of beams of 1 225 to 60 625 nodes.
const CELLS: [usize; 5] = [6, 10, 13, 16, 24];

/// Largest difference between the two ends of a run, as a part of the body's largest coordinate: both stop at Newton's tolerance.
const AGREEMENT: f64 = 1e-8;

/// A scene of the table.
struct Row {
    name: String,
    run: RunArguments,
}

/// Times beams, and the large armadillo, with the solver for their size on the processor and with that on the device, and prints a table.
pub fn run(arguments: &SizesArguments) -> Result<(), End> {
    println!(
        "| scene | nodes | elements | one thread, ms per step | all threads, ms per step | device, ms per step | all threads over device |"
    );
    println!("|---|---:|---:|---:|---:|---:|---:|");
    let cells = if arguments.cells.is_empty() { CELLS.to_vec() } else { arguments.cells.clone() };
    let mut ratios = Vec::new();
    for row in rows(arguments, &cells) {
        let on_device = RunArguments { overrides: vec![GPU.parse().map_err(End::unusable)?], ..row.run.clone() };
        let all = machine::threads();
        let (here, there) = (run::apart(&row.run, all)?, run::apart(&on_device, all)?);
        check_agreement(&row.name, &here.positions, &there.positions, AGREEMENT)?;
        let contestants: [Contestant; 3] =
            [run::timed(&row.run, 1), run::timed(&row.run, all), run::timed(&on_device, all)];
        let [one, threads, device] = race(arguments.rounds, &contestants)?[..] else {
            unreachable!("three contestants")
        };
        let ratio = threads.wall / device.wall;
        println!(
            "| {} | {} | {} | {:.2} | {:.2} | {:.2} | {ratio:.2} |",
            row.name,
            here.nodes,
            here.elements,
            1e3 * one.wall,
            1e3 * threads.wall,
            1e3 * device.wall
        );
        ratios.push((here.nodes, ratio));
    }
    match ratios.iter().filter(|(_, ratio)| *ratio > 1.0).map(|(nodes, _)| nodes).min() {
        Some(nodes) => println!("\nThe device is faster from {nodes} nodes on."),
        None => println!("\nThe device is faster for none of these bodies."),
    }
    Ok(())
}

fn rows(arguments: &SizesArguments, cells: &[usize]) -> Vec<Row> {
    let scene = |scene: &str, cells: Option<usize>| RunArguments {
        scene: scene.to_owned(),
        steps: Some(arguments.steps),
        cells,
        solver: None,
        overrides: Vec::new(),
        data: arguments.data.clone(),
    };
    let mut rows: Vec<Row> = cells
        .iter()
        .map(|&cells| Row { name: format!("beam, {cells} cells per metre"), run: scene("beam", Some(cells)) })
        .collect();
    if arguments.cells.is_empty() {
        rows.push(Row { name: "arma-large".to_owned(), run: scene("arma-large", None) });
    }
    rows
}
