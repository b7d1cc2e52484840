//! The graphics device beside the processor, on the same scenes.

mod batches;
mod bodies;

use std::path::Path;

use fem_engine::solvers::device_name;
use fem_study::machine::Machine;

use crate::cli::SizesArguments;
use crate::end::End;

/// The solver of the device.
const GPU: &str = "solver={kind = \"gpu\"}";

/// Refuses ends of a run that are farther apart than this part of the body's largest coordinate, and ends that are not finite.
fn check_agreement(name: &str, here: &[f64], there: &[f64], bound: f64) -> Result<(), End> {
    let larger = |most: f64, x: f64| if x <= most { most } else { x };
    let largest = here.iter().fold(0.0, |most, x| larger(most, x.abs()));
    let apart = here.iter().zip(there).fold(0.0, |most, (a, b)| larger(most, (a - b).abs()));
    if apart <= bound * largest && there.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    Err(End::wrong(format!("{name}: device and processor end {apart:.1e} m apart")))
}

/// Times bodies of increasing size, then batches of many small bodies, and prints a table of each.
pub fn run(arguments: &SizesArguments) -> Result<(), End> {
    let device = device_name().map_err(End::unusable)?;
    println!("{}; device: {device}\n", Machine::this(Path::new(".")).line());
    bodies::run(arguments)?;
    println!();
    batches::run(arguments)
}
