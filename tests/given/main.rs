//! Tests of the given functions, and of properties of the reference solution that the pages do not ask of a student.

#![allow(non_snake_case)] // V, T, F, J, C and D are the names that the mathematics and the course use

mod assembly;
mod kinematics;
mod project;
mod solution;
mod solve;

use grader::properties::outcome::Outcome;
use grader::properties::random;
use proptest::strategy::Strategy;

/// Checks a property with random inputs, the same ones in every run.
fn for_all<S: Strategy>(inputs: S, property: impl Fn(S::Value) -> Outcome) -> Outcome {
    random::for_all(2024, inputs, property)
}
