//! The error of a value that cannot be simulated.

use thiserror::Error;

/// A quantity that is refused, its problem and the remedy.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{field} {problem}")]
pub struct Refusal {
    /// The quantity, by its key in a scene file, such as `material.young` or `planes[0].point`.
    pub field: String,
    /// The problem and its remedy. It continues the sentence that begins with `field`.
    pub problem: String,
}

impl Refusal {
    /// The refusal of a field.
    pub fn new(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { field: field.into(), problem: problem.into() }
    }
}
