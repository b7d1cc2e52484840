//! The checks that an implementation of the 22 functions is held to; they are written in grader/src/properties.
//!
//! `cargo test --no-default-features --test functions psi_neo_hookean` runs those of one function and of the functions
//! whose names contain its name. A message says what is wrong and which page to read.

#![allow(non_snake_case)] // V, T, F, C and D are the names that the mathematics and the course use

use std::panic;
use std::process::ExitCode;

use finite_elements_3d as course;
use grader::implementation::Local;
use grader::properties::outcome::told;
use grader::properties::{Check, Course, FUNCTIONS};
use grader_child::{Functions, plain_functions};
use libtest_mimic::{Arguments, Trial};

/// Random inputs are the same ones in every run.
const SEED: u64 = 2024;

macro_rules! table {
    ($($number:literal $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The functions of src/.
        const WRITTEN: Functions = Functions {
            $($name: course::$name,)*
            quadrature_of_number: |V, element, volume, f| course::quadrature_single_point(V, element, volume, f),
            quadrature_of_vector: |V, element, volume, f| course::quadrature_single_point(V, element, volume, f),
            linearly_implicit_euler: |q, qdot, dt, mass, force, stiffness, solve| {
                course::linearly_implicit_euler(q, qdot, dt, mass, force, stiffness, solve)
            },
            newtons_method: |x0, f, g, H, solve, max_steps| course::newtons_method(x0, f, g, H, solve, max_steps),
            implicit_euler: |q, qdot, dt, mass, energy, force, stiffness, solve| {
                course::implicit_euler(q, qdot, dt, mass, energy, force, stiffness, solve)
            },
        };
    };
}
plain_functions!(table);

fn trial(function: &'static str, check: &Check) -> Trial {
    let run = check.run;
    Trial::test(format!("{function}::{}", check.name), move || {
        let written = Local(WRITTEN);
        run(&Course { subject: &written, trusted: &written, seed: SEED })
            .map_err(|mistake| told(function, &mistake).into())
    })
}

fn main() -> ExitCode {
    // The message of a check tells of a panic; a second report would stand between the results.
    panic::set_hook(Box::new(|_| {}));
    let trials =
        FUNCTIONS.iter().flat_map(|(function, checks)| checks.iter().map(|check| trial(function, check))).collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}
