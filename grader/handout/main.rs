//! Checks your functions: `cargo run -p grader -- check`.

use std::env;
use std::process::ExitCode;

/// The sandbox starts this program a second time with the hidden command `confine`; all else is for you.
fn main() -> ExitCode {
    let arguments: Vec<String> = env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    match arguments.split_first() {
        Some((command, rest)) if command == "confine" => grader::sandbox::confine(rest),
        _ => grader::check::main(),
    }
}
