//! Wrong functions that were written after the rules had been tried on both of the other sets.

use super::Mistake;

mod algorithms;
mod formulas;

/// All of them.
pub const ALL: [&[Mistake]; 2] = [formulas::MISTAKES, algorithms::MISTAKES];
