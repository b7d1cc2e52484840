//! The command line of a student's grader, which can check and nothing else.

use std::env;
use std::panic;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{ArgAction, Parser, Subcommand};

use super::reset::{Done, reset};
use super::{CheckError, run};
use crate::sandbox::confine;

#[derive(Parser)]
#[command(name = "grader", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Check the functions of this repository, and tell which one to work on next.
    Check(Options),
    /// Put a function back as it was handed out; the present file is kept in the folder `old`.
    Reset {
        /// The function.
        name: String,
        /// The repository.
        #[arg(value_name = "DIR", default_value = ".")]
        folder: PathBuf,
    },
}

/// Options of `check`.
#[derive(clap::Args)]
pub struct Options {
    /// The repository.
    #[arg(value_name = "DIR", default_value = ".")]
    pub folder: PathBuf,
    /// One function alone.
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// Check again whenever a file is saved.
    #[arg(long)]
    pub watch: bool,
    /// Check another's folder even where this machine has no sandbox: its functions may then do what you may.
    #[arg(long)]
    pub without_sandbox: bool,
    /// Tell what is wrong, with figures and inputs; twice: common mistakes as well.
    #[arg(long, action = ArgAction::Count)]
    pub hint: u8,
    /// End with exit code 3 if a function does not pass.
    #[arg(long, conflicts_with = "watch")]
    pub exit_code: bool,
}

/// The whole program: 0 checked (passed or not), 1 the checks themselves failed, 2 unusable arguments, 3 a function does not pass and
/// `--exit-code` asks for it.
pub fn main() -> ExitCode {
    // The sandbox starts this program a second time.
    let words: Vec<String> = env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    if words.first().is_some_and(|word| word == "confine") {
        return confine(&words[1..]);
    }
    let command = Arguments::parse().command;
    // Panics of what is checked are told with its check.
    panic::set_hook(Box::new(|_| {}));
    match panic::catch_unwind(|| done(&command)) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(error)) => {
            eprintln!("{error}");
            ExitCode::from(error.exit_code())
        }
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
            eprintln!("the checks themselves failed ({}); nothing was checked", text.unwrap_or("without a message"));
            ExitCode::FAILURE
        }
    }
}

fn done(command: &Command) -> Result<(), CheckError> {
    match command {
        Command::Check(options) => run(options),
        Command::Reset { name, folder } => {
            match reset(folder, name)? {
                Done::Kept(path) => println!("src/{name}.rs is as it was handed out; your file is {}", path.display()),
                Done::New => println!("src/{name}.rs is there again, as it was handed out"),
                Done::Unchanged => println!("src/{name}.rs is as it was handed out; there was nothing to reset"),
            }
            Ok(())
        }
    }
}
