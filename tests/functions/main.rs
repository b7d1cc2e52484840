//! The checks of the 22 functions; they are written in grader/src/properties.
//!
//! `cargo test --no-default-features --test functions psi_neo_hookean` runs those of one function and of the functions
//! whose names contain its name. A message names the error and the page to read.

#![allow(non_snake_case)] // V, T, F, C and D are the names that the mathematics and the course use

use std::panic;
use std::process::ExitCode;

use finite_elements_3d as course;
use grader::implementation::Local;
use grader::properties::outcome::message_of;
use grader::properties::{Check, Course, FUNCTIONS};
use grader_child::{Functions, functions_of};
use libtest_mimic::{Arguments, Trial};

/// Random inputs are the same ones in every run.
const SEED: u64 = 2024;

/// The functions of src/.
const WRITTEN: Functions = functions_of!(course);

fn trial(function: &'static str, check: &Check) -> Trial {
    let run = check.run;
    Trial::test(format!("{function}::{}", check.name), move || {
        let written = Local(WRITTEN);
        run(&Course { subject: &written, trusted: &written, seed: SEED })
            .map_err(|mistake| message_of(function, &mistake).into())
    })
}

fn main() -> ExitCode {
    // The message of a check reports a panic; a second report would stand between the results.
    panic::set_hook(Box::new(|_| {}));
    let trials =
        FUNCTIONS.iter().flat_map(|(function, checks)| checks.iter().map(|check| trial(function, check))).collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}
