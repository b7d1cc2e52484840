//! Experiments of the theses from which this software descends, repeated beside the figures that they print.

pub mod flat;
mod mistake;
mod output;
pub mod rtfem;

use fem_chart::Picture;

use crate::machine::Machine;

pub use output::write;

/// A statement that must be true of an experiment's outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The statement.
    pub statement: String,
    /// The figure of the thesis; empty where it has none.
    pub theirs: String,
    /// Our figure.
    pub ours: String,
    /// True if the statement holds; `None` where a short run cannot tell.
    pub holds: Option<bool>,
}

impl Mark {
    /// A mark without a figure of the thesis.
    pub fn new(statement: impl Into<String>, ours: impl Into<String>, holds: bool) -> Self {
        Self { statement: statement.into(), theirs: String::new(), ours: ours.into(), holds: Some(holds) }
    }

    /// Adds the figure of the thesis.
    pub fn beside(self, theirs: impl Into<String>) -> Self {
        Self { theirs: theirs.into(), ..self }
    }
}

/// Numbers with a name for each column. A name that begins with `>` aligns its column to the right.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Name of the file, without its ending.
    pub name: String,
    /// Names of the columns, with units.
    pub head: Vec<&'static str>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<String>>,
}

/// A picture with its caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of the file, without its ending.
    pub name: String,
    /// The picture.
    pub picture: Picture,
    /// The caption.
    pub caption: String,
}

/// A part of an experiment.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its name as an argument of the program.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// A paragraph: the setting, the thesis' figure, the mistake behind it.
    pub text: String,
    /// Statements that must be true of it.
    pub marks: Vec<Mark>,
    /// Its numbers.
    pub tables: Vec<Table>,
    /// Its pictures.
    pub figures: Vec<Figure>,
}

impl Part {
    /// Returns true if no mark fails.
    pub fn passes(&self) -> bool {
        self.marks.iter().all(|mark| mark.holds != Some(false))
    }
}

/// An experiment with the machine that it ran on.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// Name of its page, without the ending.
    pub name: &'static str,
    /// Title of its page.
    pub title: &'static str,
    /// First paragraph of its page.
    pub text: &'static str,
    /// The machine and the program.
    pub machine: Machine,
    /// The runs were shortened.
    pub quick: bool,
    /// Its parts.
    pub parts: Vec<Part>,
}
