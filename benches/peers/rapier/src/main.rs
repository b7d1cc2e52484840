//! A rectangle or box, clamped at x = 0, under its weight, as a soft body of rapier with the solver `Fem`.
//!
//! Two lengths in `--size` choose rapier2d, three rapier3d; `--precision f64` their crates in double precision. It prints one line of
//! JSON: `seconds` is the wall time of all steps without the setup. `--state` writes the final positions as the program
//! `finite-elements-3d` does. `compare.py` runs both.

mod mesh;
mod options;
mod simulate;

use std::process::ExitCode;

use serde_json::json;

use options::Options;
use simulate::Run;

fn main() -> ExitCode {
    match Options::read(std::env::args().skip(1)).and_then(|options| run(&options)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(options: &Options) -> Result<(), String> {
    let mesh = mesh::mesh(&options.size, options.cells);
    let simulate = match (options.size.len(), options.double) {
        (2, false) => simulate::flat,
        (2, true) => simulate::flat_double,
        (_, false) => simulate::solid,
        (_, true) => simulate::solid_double,
    };
    let Run { q, seconds } = simulate(options, &mesh);
    let finite = q.iter().all(|x| x.is_finite());
    let total: f64 = seconds.iter().sum();
    println!(
        "{}",
        json!({ "nodes": mesh.nodes.len(), "elements": mesh.elements.len(), "seconds": total, "finite": finite })
    );
    if let Some(path) = &options.state {
        let state = json!({ "time": options.dt * options.steps as f64, "q": q });
        std::fs::write(path, state.to_string()).map_err(|error| format!("{path}: {error}"))?;
    }
    Ok(())
}
