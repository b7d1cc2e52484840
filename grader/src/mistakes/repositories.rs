//! Repository set: wrong functions in the manner of public student repositories, written after the rules and not shown to them before
//! they were measured. The comment above each function says what went wrong.
//!
//! The rules named 41 of the 44 functions; no sentence contradicted another.

use super::Mistake;

mod elements;
mod formulas;
mod meshes;
mod steps;

/// All of them.
pub const ALL: [&[Mistake]; 4] = [formulas::MISTAKES, elements::MISTAKES, meshes::MISTAKES, steps::MISTAKES];
