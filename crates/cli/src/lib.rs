//! The program's commands: runs of scenes with and without a window, studies, meshes.
//!
//! The program itself is a few lines, `src/main.rs` of the course, which hands its pipeline over as a [`Course`]. `--help` and
//! `docs/book/commands.md` tell what each command does.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J and F are the names that the mathematics and the course use

/// Prints a line of results. A reader that closes standard output early, such as `| head`, is no failure.
macro_rules! say {
    ($($line:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stdout(), $($line)*);
    }};
}

#[cfg(feature = "engine")]
mod batch;
mod build;
mod checkpoints;
mod cli;
mod course;
mod end;
#[cfg(feature = "engine")]
mod engine;
mod explain;
mod headless;
mod list;
mod mesh;
mod missing;
mod pictures;
mod probes;
mod progress;
mod results;
mod run;
mod signals;
#[cfg(feature = "engine")]
mod study;
mod window;
#[cfg(not(feature = "engine"))]
mod without_engine;

use std::process::ExitCode;

use clap::Parser;
use cli::{Arguments, Command};
pub use course::{Build, Course};
#[cfg(not(feature = "engine"))]
use without_engine::{batch, engine, study};

/// Reads the arguments, runs the command, and returns its exit code.
pub fn run(course: &Course) -> ExitCode {
    let arguments = Arguments::parse();
    let result = match &arguments.command {
        Some(Command::List) => list::print_scenes(course),
        Some(Command::Mesh { action }) => action.run(),
        Some(Command::Study(study)) => study.run(course),
        None => missing::caught(course, || run::run(course, &arguments.run)),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(end) => end.report(),
    }
}
