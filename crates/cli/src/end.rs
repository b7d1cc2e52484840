//! Exit codes and the last message of the program.

use std::fmt;
use std::process::ExitCode;

use fem_model::simulation::Failure;

/// A reason for which the program ends early.
#[derive(Debug)]
pub enum End {
    /// The simulation failed: exit code 1.
    Failed(Failure),
    /// The simulation stopped with this message: exit code 1.
    Stopped(String),
    /// A signal ended the run after a step; exit code 130 or 143.
    Interrupted {
        /// The exit code.
        code: u8,
        /// The step, and how to go on.
        message: String,
    },
    /// Arguments, scene or output files cannot be used: exit code 2.
    Unusable(String),
}

impl End {
    /// Exit code 2. The text of `error` names file, line or field, and the remedy.
    pub fn unusable(error: impl fmt::Display) -> Self {
        Self::Unusable(error.to_string())
    }

    /// The message for the user.
    pub fn message(&self) -> String {
        match self {
            Self::Failed(failure) => failure.to_string(),
            Self::Stopped(message) | Self::Interrupted { message, .. } | Self::Unusable(message) => message.clone(),
        }
    }

    /// Prints the message to stderr and returns the exit code.
    pub fn report(&self) -> ExitCode {
        let (code, kind) = match self {
            Self::Failed(_) | Self::Stopped(_) => (1, "error"),
            Self::Unusable(_) => (2, "error"),
            Self::Interrupted { code, .. } => (*code, "interrupted"),
        };
        eprintln!("{kind}: {}", self.message());
        ExitCode::from(code)
    }
}
