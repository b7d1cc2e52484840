//! The compiler's messages and the results of the checks, function by function.

use std::collections::{BTreeMap, BTreeSet};

use super::run_checks::CheckResult;
use crate::properties::{Check, FUNCTIONS};
use crate::status::Status;

/// Names of functions.
pub type Names = BTreeSet<&'static str>;

/// The compiler's messages and the results of the checks of one function.
#[derive(Clone)]
pub struct Found {
    pub(super) status: Status,
    pub(super) messages: Vec<String>,
    pub(super) results: Vec<CheckResult>,
    /// It can be called.
    pub(super) is_in_program: bool,
    /// The functions that its text names, itself not among them.
    pub(super) names: Names,
    /// The functions without which nothing can be said of it: those that its text calls and that do not answer in time, or those of
    /// whose files it uses a part that is not in the program.
    pub(super) stands_still_for: Names,
}

/// The functions that were judged.
pub type Judged = BTreeMap<&'static str, Found>;

impl Found {
    /// The functions that its text names or its checks ask.
    pub fn needs(&self) -> Names {
        self.results.iter().flat_map(|result| &result.asked).chain(&self.names).copied().collect()
    }
}

/// Functions and all that they call, as far as these are judged.
pub fn reached(from: Names, all: &Judged) -> Names {
    let (mut found, mut next) = (Names::new(), Vec::from_iter(from));
    while let Some(name) = next.pop() {
        if found.insert(name) {
            next.extend(all.get(name).into_iter().flat_map(|found| &found.names));
        }
    }
    found
}

/// The checks of a function.
pub fn checks_of(name: &str) -> &'static [Check] {
    FUNCTIONS.iter().find(|(found, _)| *found == name).map_or(&[], |(_, checks)| checks)
}
