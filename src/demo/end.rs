//! How the program ends: exit codes and the last message.

use std::fmt;
use std::process::ExitCode;

use fem_engine::simulation::Failure;

/// Why it ends before everything is done.
#[derive(Debug)]
pub enum End {
    /// The simulation failed: exit code 1.
    Failed(Failure),
    /// The simulation stopped for a reason of its own, told in words: exit code 1.
    Stopped(String),
    /// Arguments, scene or output files cannot be used: exit code 2.
    Unusable(String),
}

impl End {
    /// An error whose text names file, line or field, and the remedy.
    pub fn unusable(error: impl fmt::Display) -> Self {
        Self::Unusable(error.to_string())
    }

    /// Says it on stderr and gives the exit code.
    pub fn report(&self) -> ExitCode {
        let (code, message) = match self {
            Self::Failed(failure) => (1, failure.to_string()),
            Self::Stopped(message) => (1, message.clone()),
            Self::Unusable(message) => (2, message.clone()),
        };
        eprintln!("error: {message}");
        ExitCode::from(code)
    }
}
