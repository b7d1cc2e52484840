//! The grader's program: hands out exercises, checks them, grades submissions and whole classes.

#![allow(non_snake_case)] // V, T, F, C and D are the names that the mathematics and the course use

mod archive;
mod assess;
mod class;
mod cli;
mod commands;
mod diagnosis;
mod feedback;
mod grade;
mod grading;
mod handout;
#[cfg(test)]
mod mistakes;
mod new_folder;
mod own_checks;
mod pack;
mod reference;
mod reports;
mod rubric;
mod seed;
mod similar;
mod variants;
mod weights;

use std::env;
use std::panic;
use std::process::ExitCode;

use clap::Parser;

use cli::{Arguments, Command};
use pack::PackOptions;

fn main() -> ExitCode {
    // File names that are not valid Unicode are graded like others.
    let words: Vec<String> = env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    if words.first().is_some_and(|word| word == "confine") {
        return grader::sandbox::confine(&words[1..]);
    }
    let arguments = Arguments::parse();
    // Checks catch the panics of the functions that they judge. These are part of the result and are not printed.
    panic::set_hook(Box::new(|_| {}));
    let done = panic::catch_unwind(|| match arguments.command {
        Command::Handout { to, rubric } => commands::handout(&to, rubric.as_deref()),
        Command::Check(options) => commands::check(&options),
        Command::Grade { submission, options, metadata, again, ends_with } => {
            commands::grade(&submission, &options, metadata.as_deref(), &again, ends_with)
        }
        Command::Class { folder, roster, options, jobs, shard, only, function } => {
            commands::class((&folder, roster), &options, jobs, shard, (only, function))
        }
        Command::Feedback { results, out, zip } => commands::feedback(&results, &out, zip.as_deref()),
        Command::Similar { folder, roster, given, out, rubric } => {
            commands::similar((&folder, roster.as_deref()), &given, &out, rubric.as_deref())
        }
        Command::Merge { folders, out } => commands::merge(&folders, &out),
        Command::Weights { rubric } => commands::weights(rubric.as_deref()),
        Command::Sandbox => commands::sandbox_layers(),
        Command::Pack { platform, out, seed, rubric, vendor } => {
            let seed = seed.unwrap_or_else(seed::drawn);
            let repository = grading::repository();
            commands::pack(PackOptions {
                platform,
                out,
                repository,
                seed,
                rubric,
                functions: 0,
                checks: Vec::new(),
                vendor,
            })
        }
    });
    match done {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(problem)) => {
            eprintln!("{}", problem.message);
            ExitCode::from(problem.code)
        }
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
            eprintln!("the grader itself failed ({}); nothing was graded", text.unwrap_or("without a message"));
            ExitCode::from(commands::GRADER_FAILED)
        }
    }
}
