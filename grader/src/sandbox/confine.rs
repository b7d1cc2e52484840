//! The launcher's subcommand.

use std::process::ExitCode;

use super::spec::Spec;
use super::{enter, supervise};

/// The arguments of `confine`.
///
/// The grader calls it with `keep SPEC`; it calls itself with `enter PIPE SPEC`; `nothing` is the program of a trial.
pub fn confine(arguments: &[String]) -> ExitCode {
    let outcome = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["nothing"] => Ok(()),
        ["keep", spec] => {
            serde_json::from_str::<Spec>(spec).map_err(|error| error.to_string()).and_then(supervise::supervise)
        }
        ["enter", pipe, spec] => enter::enter(pipe, spec),
        _ => Err("`confine` is for the grader's own use".to_string()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}
