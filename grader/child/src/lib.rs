//! The link between a submission and the process that judges it.
//!
//! A submission's functions become a [`Functions`] table; [`serve`](serve()) calls them as the parent asks and returns their
//! results. This crate contains no right answers.

#![allow(non_snake_case)] // V, T, F, C and D are the names that the mathematics and the course use
#![deny(missing_docs)]

pub mod algebra;
mod functions;
mod serve;
pub mod simulation;
pub mod socket;
mod standard;
pub mod wire;

pub use functions::{
    Exercise, Force, Functions, GivenSolve, Gradient, Hessian, Integrand, NAMES, Objective, Solve, Stiffness, UNWRITTEN,
};
pub use serve::serve;
