//! The demo: `cargo run -- arma`. Reads the arguments, runs the command, and returns its exit code.

/// Prints a line of results. A reader that closes standard output early, such as `| head`, is no failure.
macro_rules! say {
    ($($line:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stdout(), $($line)*);
    }};
}

mod demo {
    pub mod batch;
    pub mod build;
    pub mod checkpoints;
    pub mod cli;
    pub mod data;
    pub mod end;
    pub mod engine;
    pub mod explain;
    pub mod headless;
    pub mod list;
    pub mod mesh;
    pub mod missing;
    pub mod pictures;
    pub mod probes;
    pub mod progress;
    pub mod results;
    pub mod run;
    pub mod signals;
    pub mod study;
    pub mod window;
}

use std::process::ExitCode;

use clap::Parser;
use demo::cli::{Arguments, Command};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match &arguments.command {
        Some(Command::List) => demo::list::print_scenes(),
        Some(Command::Mesh { action }) => action.run(),
        Some(Command::Study(study)) => study.run(),
        None => demo::missing::caught(|| demo::run::run(&arguments.run)),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(end) => end.report(),
    }
}
