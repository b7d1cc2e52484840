//! Final validation set: wrong functions that were written after the rules had been run on the training and validation sets.

use super::Mistake;

mod algorithms;
mod formulas;

/// All of them.
pub const ALL: [&[Mistake]; 2] = [formulas::MISTAKES, algorithms::MISTAKES];
