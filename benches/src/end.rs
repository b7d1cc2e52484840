//! Errors of the program and their exit codes.

use std::fmt;
use std::process::ExitCode;

/// The reason of a failure.
#[derive(Debug)]
pub enum End {
    /// Arguments, scenes or programs that cannot be used.
    Unusable(String),
    /// A timed program failed, or its answer disagrees.
    Wrong(String),
}

impl End {
    /// An error in the arguments or in the files that they name.
    pub fn unusable(error: impl fmt::Display) -> Self {
        Self::Unusable(error.to_string())
    }

    /// A failure of a timed program.
    pub fn wrong(error: impl fmt::Display) -> Self {
        Self::Wrong(error.to_string())
    }

    /// 2 for unusable arguments, 1 for failures.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Unusable(_) => ExitCode::from(2),
            Self::Wrong(_) => ExitCode::from(1),
        }
    }
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unusable(message) | Self::Wrong(message) => f.write_str(message),
        }
    }
}
