//! The reference: our own solution, linked with the grader's own process and with no process that holds student code.

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

/// Relative error that round-off alone does not reach, and that no student should fear.
pub const TOLERANCE: f64 = 1e-9;

/// Our own solution as a table.
pub const REFERENCE: Functions = functions_of!(solved);
