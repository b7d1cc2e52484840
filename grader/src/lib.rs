//! Judges implementations of the 22 functions: the part that students can run on their own machines.
//!
//! The instructor's part (the reference, diagnoses, classes, reports) belongs to the program, `main.rs`.

#![allow(non_snake_case)] // V, T, F, C and D are the names that the mathematics and the course use
#![deny(missing_docs)]

pub mod check;
pub mod compile;
pub mod implementation;
pub mod properties;
pub mod sandbox;
pub mod status;
pub mod submission;
