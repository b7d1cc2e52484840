//! The reference: the course's solution, linked with the grader's own process, and never with a process that runs student code.

mod calls;
pub mod compare;
mod elements;
pub mod judge;
mod meshes;
mod picks;
mod random;
mod scales;
mod steps;
pub mod systems;
#[cfg(test)]
mod tests;
pub mod trial;

use finite_elements_3d as solved;
use grader_child::{Functions, functions_of};

pub use compare::compare;
pub use judge::trials;

/// Relative error of the comparison, well above round-off in any right function.
pub const TOLERANCE: f64 = 1e-9;

/// The course's solution as a table.
pub const REFERENCE: Functions = functions_of!(solved);
