//! Reproducible timings of the engine: beside its peers, part by part, by size, by solver and by frames.
//!
//! Whatever is timed runs in a process of its own, so that its threads, its memory and its processor time are its own.

#![allow(non_snake_case)] // C and D are the names that the mathematics uses

mod cli;
mod end;
mod frame;
mod gpu;
mod parts;
mod peers;
mod race;
mod run;
mod scaling;
mod solvers;
mod table;

use std::process::ExitCode;

use clap::Parser;

use cli::{Arguments, Command};

fn main() -> ExitCode {
    let ended = match Arguments::parse().command {
        Command::Peers(arguments) => peers::run(&arguments),
        Command::Parts(arguments) => parts::run(&arguments),
        Command::Scaling(arguments) => scaling::run(&arguments),
        Command::Solvers(arguments) => solvers::run(&arguments),
        Command::Gpu(arguments) => gpu::run(&arguments),
        Command::Frame(arguments) => frame::run(&arguments),
        Command::Run(arguments) => run::print(&arguments),
    };
    match ended {
        Ok(()) => ExitCode::SUCCESS,
        Err(end) => {
            eprintln!("error: {end}");
            end.exit_code()
        }
    }
}
