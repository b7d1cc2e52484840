//! Wrong functions written before their author had read a rule of the diagnosis or the name of a mistake. The comment above each
//! one says what the author had in mind; the names are those which say the same.
//!
//! At first sight 88 of 103 were named; the rules that the others suggested name 97.

use super::Mistake;

mod display;
mod elements;
mod formulas;
mod meshes;
mod steps;

/// All of them.
pub const ALL: [&[Mistake]; 5] =
    [formulas::MISTAKES, elements::MISTAKES, meshes::MISTAKES, display::MISTAKES, steps::MISTAKES];
