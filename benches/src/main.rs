//! Reproducible timings of the engine: beside its peers, part by part, by size, by solver and by frames.
//!
//! Whatever is timed runs in a process of its own, so that its threads, its memory and its processor time are its own.

#![allow(non_snake_case)] // C and D are the names that the mathematics uses

mod book;
mod cli;
mod course;
mod end;
mod frame;
mod gpu;
mod parts;
mod peers;
mod race;
mod run;
mod scaling;
mod solvers;
mod statics;
mod table;

use std::process::ExitCode;

use clap::Parser;

use cli::{Arguments, Command};
use end::End;

fn main() -> ExitCode {
    let Arguments { command, book } = Arguments::parse();
    let ended = match (book, command) {
        (Some(page), _) => book::write(&page, &cli::without_book(std::env::args().skip(1))),
        (None, command) => carry_out(command),
    };
    match ended {
        Ok(()) => ExitCode::SUCCESS,
        Err(end) => {
            eprintln!("error: {end}");
            end.exit_code()
        }
    }
}

fn carry_out(command: Command) -> Result<(), End> {
    match command {
        Command::Course(arguments) => course::run(&arguments),
        Command::Peers(arguments) => peers::run(&arguments),
        Command::Parts(arguments) => parts::run(&arguments),
        Command::Scaling(arguments) => scaling::run(&arguments),
        Command::Solvers(arguments) => solvers::run(&arguments),
        Command::Gpu(arguments) => gpu::run(&arguments),
        Command::Frame(arguments) => frame::run(&arguments),
        Command::Run(arguments) => run::print(&arguments),
        Command::Statics(arguments) => statics::run(&arguments),
    }
}
