//! The experiments of a thesis on two-dimensional deformation with plasticity (2019): explicit integration of triangles from pictures.

mod contact;
mod convergence;
mod drop;
mod mesh;
mod mistakes;
mod modulus;
mod object;
mod plasticity;
mod simulation;
mod speed;
mod stability;

use std::path::Path;

use super::{Experiment, Part};
use crate::machine::Machine;

/// A part: its name, and its run, which takes the folder of the pictures' `data` and whether it is to be short.
type Entry = (&'static str, fn(&Path, bool) -> Result<Part, String>);

const PARTS: &[Entry] = &[
    ("stability", stability::run),
    ("speed", speed::run),
    ("modulus", modulus::run),
    ("mesh", mesh::run),
    ("convergence", convergence::run),
    ("plasticity", plasticity::run),
    ("drop", drop::run),
    ("contact", contact::run),
    ("mistakes", mistakes::run),
];

/// Names of the parts, in their order.
pub fn names() -> impl Iterator<Item = &'static str> {
    PARTS.iter().map(|(name, _)| *name)
}

/// Runs one part, or all of them. `data` is the folder with `pictures`.
///
/// # Errors
/// A picture that cannot be read, or a body that cannot be built.
pub fn run(part: Option<&str>, data: &Path, quick: bool) -> Result<Experiment, String> {
    let chosen = PARTS.iter().filter(|(name, _)| part.is_none_or(|part| part == *name));
    Ok(Experiment {
        name: "flat",
        title: "Flat bodies",
        text: "Experiments of a thesis on two-dimensional deformation with plasticity (2019), repeated by this engine. Its figures stand beside ours, \
               and the mistakes behind them are named.",
        machine: Machine::this(data),
        quick,
        parts: chosen.map(|(_, run)| run(data, quick)).collect::<Result<_, _>>()?,
    })
}
