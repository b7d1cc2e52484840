//! The seam of all studies: a table of cases, one runner for them, and one place where their rows become tables, pictures and pages.
//!
//! A [`Study`] lists its cases and says what becomes of their rows. [`carry_out`] runs them, on one machine or in shards on several, goes on
//! where a killed run was, and joins shards.

mod journal;
pub mod pack;
mod page;
mod runner;
#[cfg(test)]
mod tests;

use std::io;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::machine::Machine;

pub use fem_reference::{Problem, Result};
pub use journal::{Shard, arguments};
pub(crate) use page::csv_text;
pub use page::{Column, Figure, Mark, Page, Part, Table, write};
pub use runner::{Deadline, Run, Stopped, carry_out, guarded, rows};

/// A case of a study.
pub struct Case<'a, Row> {
    /// Its name, for the terminal and for messages.
    pub name: String,
    /// Computes its row. A failure becomes a row too.
    pub work: Box<dyn FnOnce() -> Row + Send + 'a>,
}

impl<'a, Row> Case<'a, Row> {
    /// A case.
    pub fn new(name: impl Into<String>, work: impl FnOnce() -> Row + Send + 'a) -> Self {
        Self { name: name.into(), work: Box::new(work) }
    }
}

/// Every pair of a value of one list and a value of another, the second fastest.
pub fn pairs<A: Clone, B: IntoIterator + Clone>(
    first: impl IntoIterator<Item = A>,
    second: B,
) -> impl Iterator<Item = (A, B::Item)> {
    first.into_iter().flat_map(move |a| second.clone().into_iter().map(move |b| (a.clone(), b)))
}

/// A table of cases.
pub trait Study: Sync {
    /// What a case becomes.
    type Row: Serialize + DeserializeOwned + Send;

    /// The arguments of the program that name this study: shards with other ones are not joined.
    fn arguments(&self) -> Vec<String>;

    /// The cases, in the order of the rows.
    fn cases(&self) -> Vec<Case<'_, Self::Row>>;

    /// Number of cases that run at once; more than one makes measured times too long.
    fn threads(&self) -> usize {
        1
    }

    /// A line for the terminal about a row that is not as expected.
    fn remark(&self, _row: &Self::Row) -> Option<String> {
        None
    }

    /// Writes the files of all rows into a folder.
    fn finish(&self, found: Found<Self::Row>, out: &Path) -> io::Result<Finished>;
}

/// The rows of a study.
pub struct Found<Row> {
    /// In the order of the cases.
    pub rows: Vec<Row>,
    /// The machine on which they were computed, or the machines.
    pub machine: Machine,
    /// Wall-clock time, s; of joined shards, that of all cases.
    pub seconds: f64,
}

/// The end of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finished {
    /// Lines for the terminal: the answers, and the files to open first.
    pub lines: Vec<String>,
    /// What is not as expected; `None` if everything is.
    pub failed: Option<String>,
}

/// The reason why a study has no results.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// A folder cannot be used, as a sentence with a remedy.
    Unusable(String),
    /// Shards lack rows.
    Incomplete(String),
}
