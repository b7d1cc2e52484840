//! What the grader and its launcher tell each other.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::Confined;

/// What the launcher is to do, its last argument.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spec {
    /// The program.
    pub confined: Confined,
    /// The layers, which must all hold.
    pub layers: BTreeSet<String>,
    /// The user for `own_user`.
    pub owner: u32,
    /// Which descriptor of the launcher leads to the grader.
    pub control: Control,
}

/// Where the launcher finds the socket to the grader. The other standard descriptors are the program's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Control {
    /// The program reads nothing.
    Stdin,
    /// The program prints nowhere.
    Stdout,
}

/// What the launcher tells the grader, one line each.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum News {
    /// The program has begun.
    Started,
    /// A layer failed, or there is no such program.
    Refused(String),
    /// The program and all that it started are gone.
    Ended {
        /// Exit code.
        code: Option<i32>,
        /// Signal.
        signal: Option<i32>,
        /// Whether its time was over.
        timed_out: bool,
        /// Processor time, s.
        seconds: f64,
    },
}
