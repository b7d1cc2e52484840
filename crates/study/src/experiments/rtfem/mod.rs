//! The experiment of a thesis on real-time finite elements (2018): a torus, squashed between two opposite sides.

mod equilibrium;
mod materials;
mod methods;
mod mistakes;
mod modulus;
mod momentum;
mod picture;
mod precision;
mod setting;
mod slivers;
mod speed;
mod structures;
mod torus;

use super::Collection;

/// The thesis.
pub const THESIS: Collection = Collection {
    name: "rtfem",
    title: "Finite elements in real time",
    text: "The experiment of a thesis on real-time linear finite elements (2018), repeated by this engine, and the comparisons that the thesis announces: \
           single and double precision, materials, bodies. Its figures stand beside ours, and its mistakes are named.",
    parts: &[
        ("speed", "Time of a step", speed::run),
        ("precision", "Single and double precision", precision::run),
        ("equilibrium", "The end of the motion", equilibrium::run),
        ("materials", "Materials", materials::run),
        ("structures", "Other bodies", structures::run),
        ("picture", "Pictures", picture::run),
        ("slivers", "Shapes of tetrahedra", slivers::run),
        ("methods", "Which method for what", methods::run),
        ("modulus", "Stiffness by iterations", modulus::run),
        ("momentum", "Momentum of a free body", momentum::run),
        ("mistakes", "Each mistake, with its figures", mistakes::run),
    ],
};
