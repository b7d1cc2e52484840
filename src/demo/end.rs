//! How the program ends: exit codes and the last message.

use std::fmt;
use std::process::ExitCode;

use fem_scene::simulation::Failure;

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

    /// What it says.
    pub fn message(&self) -> String {
        match self {
            Self::Failed(failure) => failure.to_string(),
            Self::Stopped(message) | Self::Unusable(message) => message.clone(),
        }
    }

    /// Says it on stderr and gives the exit code.
    pub fn report(&self) -> ExitCode {
        let code = match self {
            Self::Failed(_) | Self::Stopped(_) => 1,
            Self::Unusable(_) => 2,
        };
        eprintln!("error: {}", self.message());
        ExitCode::from(code)
    }
}
