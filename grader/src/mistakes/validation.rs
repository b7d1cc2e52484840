//! Wrong functions that were written after the rules of diagnosis, and without a look at what the rules make of them.

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
