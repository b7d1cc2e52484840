//! The experiment of a thesis on real-time finite elements (2018): a torus, squashed between two opposite sides.

mod block;
mod dense;
mod equilibrium;
mod materials;
mod methods;
mod mistakes;
mod modulus;
mod momentum;
mod picture;
mod precision;
mod setting;
mod speed;
mod steps;
mod structures;
mod timing;
mod torus;

use std::path::Path;

use super::{Experiment, Part};
use crate::machine::Machine;

/// A part: its name, and its run, which takes the folder `data` and whether it is to be short.
type Entry = (&'static str, fn(&Path, bool) -> Result<Part, String>);

const PARTS: &[Entry] = &[
    ("speed", speed::run),
    ("precision", precision::run),
    ("equilibrium", equilibrium::run),
    ("materials", materials::run),
    ("structures", structures::run),
    ("picture", picture::run),
    ("methods", methods::run),
    ("modulus", modulus::run),
    ("momentum", momentum::run),
    ("mistakes", mistakes::run),
];

/// Names of the parts, in their order.
pub fn names() -> impl Iterator<Item = &'static str> {
    PARTS.iter().map(|(name, _)| *name)
}

/// Runs one part, or all of them. `data` is the folder with the meshes of other bodies.
///
/// # Errors
/// A mesh that cannot be read or made, or a step that fails.
pub fn run(part: Option<&str>, data: &Path, quick: bool) -> Result<Experiment, String> {
    let chosen = PARTS.iter().filter(|(name, _)| part.is_none_or(|part| part == *name));
    Ok(Experiment {
        name: "rtfem",
        title: "Finite elements in real time",
        text: "The experiment of a thesis on real-time linear finite elements (2018), repeated by this engine, and the comparisons that the thesis announces: \
               single and double precision, materials, bodies. Its figures stand beside ours, and its mistakes are named.",
        machine: Machine::this(data),
        quick,
        parts: chosen.map(|(_, run)| run(data, quick)).collect::<Result<_, _>>()?,
    })
}
