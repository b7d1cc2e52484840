//! The outcome of a function.

use serde::{Deserialize, Serialize};

/// The outcome of a function or of one of its checks, worst last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Right.
    Passed,
    /// Answers that are wrong.
    Failed,
    /// The program with the function ended, or the function panicked.
    Crashed,
    /// No answer in time.
    TimedOut,
    /// The file does not compile.
    DidNotCompile,
    /// The file holds something that is not allowed.
    Refused,
    /// No file, or the handout's `todo!`.
    Missing,
}
