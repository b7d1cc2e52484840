//! The numbers of a Gmsh file one after the other, whether they are text or binary.

use std::path::Path;

use nalgebra::Vector3;

use super::super::words::Words;
use crate::{MeshError, Problem};

/// The content of a Gmsh file. Rows are lines of text; binary files have no ends of rows.
pub(super) trait Numbers {
    /// The name of the next section, without its `$`; `None` at the end of the file.
    fn section(&mut self) -> Result<Option<String>, MeshError>;

    /// Goes to the end of a section. Returns an error if it has none.
    fn skip(&mut self, section: &str) -> Result<(), MeshError>;

    /// Begins the row after the first `found` of `announced` rows.
    fn row(&mut self, what: &'static str, announced: usize, found: usize) -> Result<(), MeshError>;

    /// Ends the row: no number may be left in it. `last` describes the last one.
    fn end_row(&self, last: &'static str) -> Result<(), MeshError>;

    /// An integer, of 4 bytes in a binary file.
    fn int(&mut self, expected: &'static str) -> Result<i64, MeshError>;

    /// An integer, of 8 bytes in a binary file.
    fn long(&mut self, expected: &'static str) -> Result<i64, MeshError>;

    /// A number, of 8 bytes in a binary file.
    fn real(&mut self, expected: &'static str) -> Result<f64, MeshError>;

    /// A finite position, m.
    fn place(&mut self) -> Result<Vector3<f64>, MeshError>;

    /// The next line, which is text in binary files too.
    fn text_line(&mut self, expected: &'static str) -> Result<String, MeshError>;

    /// Ends a section. Returns an error if it had another number of entries than it announced, of which `found` have been read.
    fn end(&mut self, section: &str, what: &'static str, announced: usize, found: usize) -> Result<(), MeshError>;

    /// The error of a problem at this place of the file.
    fn error(&self, problem: Problem) -> MeshError;

    /// A count, of 8 bytes in a binary file. Never allocate by it: the file may hold less.
    fn count(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        let count = self.long(expected)?;
        usize::try_from(count).map_err(|_| self.error(Problem::NotA { word: count.to_string(), expected }))
    }

    /// A count on a line of its own, which is text in binary files too.
    fn text_count(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        let line = self.text_line(expected)?;
        line.trim().parse().map_err(|_| self.error(Problem::NotA { word: line.trim().to_owned(), expected }))
    }
}

/// A text file.
pub(super) struct Text<'a> {
    file: &'a Path,
    lines: Box<dyn Iterator<Item = Words<'a>> + 'a>,
    /// The rest of the current line.
    line: Words<'a>,
}

impl<'a> Text<'a> {
    pub(super) fn new(file: &'a Path, text: &'a str) -> Self {
        Self { file, lines: Box::new(Words::of_lines(file, text)), line: Words::of_text(file, "") }
    }
}

impl Numbers for Text<'_> {
    fn section(&mut self) -> Result<Option<String>, MeshError> {
        let Some(line) = self.lines.next() else { return Ok(None) };
        let word = line.peek().unwrap_or_default();
        let problem =
            || Problem::NotA { word: word.to_owned(), expected: "the beginning of a section, such as `$Nodes`" };
        let name = word.strip_prefix('$').ok_or_else(|| line.error(problem()))?;
        Ok(Some(name.to_owned()))
    }

    fn skip(&mut self, section: &str) -> Result<(), MeshError> {
        let end = format!("$End{section}");
        let ends = || MeshError::in_file(self.file, Problem::Ends { expected: "the end of the last section" });
        self.lines.find(|line| line.peek() == Some(&end)).map(drop).ok_or_else(ends)
    }

    fn row(&mut self, what: &'static str, announced: usize, found: usize) -> Result<(), MeshError> {
        let line = self.lines.next().filter(|line| line.peek().is_none_or(|word| !word.starts_with('$')));
        let problem = || Problem::WrongCount { what, announced, found };
        self.line = line.ok_or_else(|| MeshError::in_file(self.file, problem()))?;
        Ok(())
    }

    fn end_row(&self, last: &'static str) -> Result<(), MeshError> {
        self.line.end(last)
    }

    fn int(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        self.line.integer(expected)
    }

    fn long(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        self.line.integer(expected)
    }

    fn real(&mut self, expected: &'static str) -> Result<f64, MeshError> {
        self.line.real(expected)
    }

    fn place(&mut self) -> Result<Vector3<f64>, MeshError> {
        self.line.place()
    }

    fn text_line(&mut self, expected: &'static str) -> Result<String, MeshError> {
        let ends = || MeshError::in_file(self.file, Problem::Ends { expected });
        self.line = self.lines.next().ok_or_else(ends)?;
        Ok(self.line.rest().to_owned())
    }

    fn end(&mut self, _: &str, what: &'static str, announced: usize, found: usize) -> Result<(), MeshError> {
        let is_end = |line: &Words| line.peek().is_some_and(|word| word.starts_with('$'));
        let more = self.lines.by_ref().take_while(|line| !is_end(line)).count();
        match found + more {
            found if found == announced => Ok(()),
            found => Err(MeshError::in_file(self.file, Problem::WrongCount { what, announced, found })),
        }
    }

    fn error(&self, problem: Problem) -> MeshError {
        self.line.error(problem)
    }
}
