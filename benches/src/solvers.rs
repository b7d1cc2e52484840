//! Which linear solver is fastest for which size.

use std::path::Path;

use clap::ValueEnum;
use fem_study::machine::{self, Machine};

use crate::cli::{RunArguments, SizesArguments, SolverName};
use crate::end::End;
use crate::race::{Contestant, race};
use crate::run;

/// Cells per metre of beams of 1 225, 4 961 and 18 785 nodes.
const CELLS: [usize; 3] = [6, 10, 16];

/// Times the beam with each solver, by one thread and by all, and prints a table.
pub fn run(arguments: &SizesArguments) -> Result<(), End> {
    let cells = if arguments.cells.is_empty() { CELLS.to_vec() } else { arguments.cells.clone() };
    println!("{}\n", Machine::this(Path::new(".")).line());
    println!("| cells per metre | solver | one thread, ms per step (processor) | all threads, ms per step |");
    println!("|---:|---|---:|---:|");
    for cells in cells {
        let beams = SolverName::value_variants().iter().map(|&solver| beam(arguments, cells, solver));
        let beams: Vec<RunArguments> = beams.collect();
        let contestants: Vec<Contestant> =
            beams.iter().flat_map(|beam| [run::timed(beam, 1), run::timed(beam, machine::threads())]).collect();
        let times = race(arguments.rounds, &contestants)?;
        for (solver, times) in SolverName::value_variants().iter().zip(times.chunks(2)) {
            println!("| {cells} | {} | {:.2} | {:.2} |", solver.name(), 1e3 * times[0].cpu, 1e3 * times[1].wall);
        }
    }
    Ok(())
}

fn beam(arguments: &SizesArguments, cells: usize, solver: SolverName) -> RunArguments {
    RunArguments {
        scene: "beam".to_owned(),
        steps: Some(arguments.steps),
        cells: Some(cells),
        solver: Some(solver),
        overrides: Vec::new(),
        data: arguments.data.clone(),
    }
}
