//! Messages between the grader and its launcher.

use std::collections::BTreeSet;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Confined;

/// The launcher's task, its last argument.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spec {
    /// The program.
    pub confined: Confined,
    /// The layers, which must all hold.
    pub layers: BTreeSet<String>,
    /// The user for `own_user`.
    pub owner: u32,
    /// The cgroup in which that of the tree is made, for `memory_cgroup`.
    pub cgroup: Option<PathBuf>,
    /// File descriptor of the launcher's connection to the grader.
    pub control: Control,
}

/// The launcher's descriptor for the socket to the grader. The other standard descriptors are the program's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Control {
    /// The program reads nothing.
    Stdin,
    /// The program prints nowhere.
    Stdout,
}

/// Reports of the launcher to the grader, one line each.
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
        /// The program's time was over.
        timed_out: bool,
        /// The memory of its processes was used up.
        out_of_memory: bool,
        /// Processor time, s.
        seconds: f64,
    },
}
