//! Training set: wrong functions that were written before the rules of diagnosis. The rules were developed on them.

use super::Mistake;

mod densities;
mod elements;
mod meshes;
mod picks;
mod shapes;
mod steps;

/// All of them.
pub const ALL: [&[Mistake]; 6] =
    [shapes::MISTAKES, densities::MISTAKES, elements::MISTAKES, meshes::MISTAKES, picks::MISTAKES, steps::MISTAKES];
