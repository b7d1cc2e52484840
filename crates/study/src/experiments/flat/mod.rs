//! The experiments of a thesis on two-dimensional deformation with plasticity (2019): explicit integration of triangles from pictures.

pub(super) mod contact;
mod convergence;
mod drop;
mod mesh;
mod mistakes;
mod modulus;
mod object;
mod plasticity;
mod speed;
mod stability;
mod sweep;

use super::Collection;

/// The thesis.
pub const THESIS: Collection = Collection {
    name: "flat",
    title: "Flat bodies",
    text: "Experiments of a thesis on two-dimensional deformation with plasticity (2019), repeated by this engine. Its figures stand beside ours, \
           and the mistakes behind them are named.",
    parts: &[
        ("stability", "Substeps of explicit integration", stability::run),
        ("speed", "Time of a frame", speed::run),
        ("modulus", "Stiffness of a strip", modulus::run),
        ("mesh", "Quality of the triangles", mesh::run),
        ("convergence", "Errors of linear and of quadratic triangles", convergence::run),
        ("plasticity", "Plastic flow", plasticity::run),
        ("drop", "Dropped bodies", drop::run),
        ("sweep", "One parameter at a time", sweep::run),
        ("contact", "Contact and friction", contact::run),
        ("mistakes", "Each mistake, with its figures", mistakes::run),
    ],
};
