//! Blind set: wrong functions by an author who had not read the rules of diagnosis or the names of mistakes. The comment above each
//! function says what the author had in mind; its names say the same.
//!
//! The rules of that time named 88 of the 103 functions. With the rules that were added for the others, 97 are named.

use super::Mistake;

mod display;
mod elements;
mod formulas;
mod meshes;
mod steps;

/// All of them.
pub const ALL: [&[Mistake]; 5] =
    [formulas::MISTAKES, elements::MISTAKES, meshes::MISTAKES, display::MISTAKES, steps::MISTAKES];
