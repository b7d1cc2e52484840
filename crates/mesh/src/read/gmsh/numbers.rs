//! The numbers of a Gmsh file one after the other: words of text, or little-endian numbers between lines of text.

use std::path::Path;

use nalgebra::Vector3;

use super::super::words::Words;
use crate::{MeshError, Problem};

/// The content of a Gmsh file. Rows are lines of text; binary files have no ends of rows.
pub(super) struct Numbers<'a> {
    file: &'a Path,
    pub is_binary: bool,
    /// The lines of a text that follow, and the rest of the current one.
    lines: Box<dyn Iterator<Item = Words<'a>> + 'a>,
    line: Words<'a>,
    /// The bytes of a binary file, and the place in them.
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Numbers<'a> {
    pub(super) fn of_text(file: &'a Path, text: &'a str) -> Self {
        let lines = Box::new(Words::of_lines(file, text));
        Self { file, is_binary: false, lines, line: Words::of_text(file, ""), bytes: &[], at: 0 }
    }

    /// The numbers of a binary file from a byte on.
    pub(super) fn of_bytes(file: &'a Path, bytes: &'a [u8], at: usize) -> Self {
        Self { is_binary: true, bytes, at, ..Self::of_text(file, "") }
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at += self.rest().iter().take_while(|byte| byte.is_ascii_whitespace()).count();
    }

    /// The bytes up to the end of the line, which is skipped.
    fn rest_of_line(&mut self) -> &'a [u8] {
        let line = self.rest().split(|&byte| byte == b'\n').next().unwrap_or_default();
        self.at = (self.at + line.len() + 1).min(self.bytes.len());
        line
    }

    fn take<const N: usize>(&mut self, expected: &'static str) -> Result<[u8; N], MeshError> {
        let chunk = *self.rest().first_chunk().ok_or_else(|| self.error(Problem::Ends { expected }))?;
        self.at += N;
        Ok(chunk)
    }

    /// The name of the next section, without its `$`; `None` at the end of the file.
    pub(super) fn section(&mut self) -> Result<Option<String>, MeshError> {
        if self.is_binary {
            self.skip_blanks();
            if self.rest().is_empty() {
                return Ok(None);
            }
            if self.rest()[0] != b'$' {
                let reason = "a section should begin here with `$`".to_owned();
                return Err(self.error(Problem::Malformed { reason }));
            }
            let line = String::from_utf8_lossy(self.rest_of_line());
            return Ok(Some(line.trim().trim_start_matches('$').to_owned()));
        }
        let Some(line) = self.lines.next() else { return Ok(None) };
        let word = line.peek().unwrap_or_default();
        let problem =
            || Problem::NotA { word: word.to_owned(), expected: "the beginning of a section, such as `$Nodes`" };
        let name = word.strip_prefix('$').ok_or_else(|| line.error(problem()))?;
        Ok(Some(name.to_owned()))
    }

    /// Goes to the end of a section. Returns an error if it has none.
    pub(super) fn skip(&mut self, section: &str) -> Result<(), MeshError> {
        let end = format!("$End{section}");
        let problem = Problem::Ends { expected: "the end of the last section" };
        if self.is_binary {
            let found = self.rest().windows(end.len()).position(|window| window == end.as_bytes());
            self.at += found.ok_or_else(|| self.error(problem))? + end.len();
            return Ok(());
        }
        let found = self.lines.find(|line| line.peek() == Some(&end));
        found.map(drop).ok_or_else(|| MeshError::in_file(self.file, problem))
    }

    /// Begins the row after the first `found` of `announced` rows.
    pub(super) fn row(&mut self, what: &'static str, announced: usize, found: usize) -> Result<(), MeshError> {
        if !self.is_binary {
            let line = self.lines.next().filter(|line| line.peek().is_none_or(|word| !word.starts_with('$')));
            let problem = || Problem::WrongCount { what, announced, found };
            self.line = line.ok_or_else(|| MeshError::in_file(self.file, problem()))?;
        }
        Ok(())
    }

    /// Ends the row: no number may be left in it. `last` describes the last one.
    pub(super) fn end_row(&self, last: &'static str) -> Result<(), MeshError> {
        if self.is_binary { Ok(()) } else { self.line.end(last) }
    }

    /// An integer, of 4 bytes in a binary file.
    pub(super) fn int(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        if !self.is_binary {
            return self.line.integer(expected);
        }
        self.take(expected).map(|bytes| i32::from_le_bytes(bytes).into())
    }

    /// An integer, of 8 bytes in a binary file.
    pub(super) fn long(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        if self.is_binary { self.take(expected).map(i64::from_le_bytes) } else { self.line.integer(expected) }
    }

    /// A number, of 8 bytes in a binary file.
    pub(super) fn real(&mut self, expected: &'static str) -> Result<f64, MeshError> {
        if self.is_binary { self.take(expected).map(f64::from_le_bytes) } else { self.line.real(expected) }
    }

    /// A finite position, m.
    pub(super) fn place(&mut self) -> Result<Vector3<f64>, MeshError> {
        if !self.is_binary {
            return self.line.place();
        }
        let mut place = Vector3::zeros();
        for x in &mut place {
            let at = self.at;
            *x = self.real("a coordinate")?;
            if !x.is_finite() {
                return Err(MeshError::in_byte(self.file, at, Problem::NotFinite { word: x.to_string() }));
            }
        }
        Ok(place)
    }

    /// The next line, which is text in binary files too.
    pub(super) fn text_line(&mut self, expected: &'static str) -> Result<String, MeshError> {
        if self.is_binary && !self.rest().is_empty() {
            return Ok(String::from_utf8_lossy(self.rest_of_line()).into_owned());
        }
        match self.lines.next() {
            Some(line) => self.line = line,
            None if self.is_binary => return Err(self.error(Problem::Ends { expected })),
            None => return Err(MeshError::in_file(self.file, Problem::Ends { expected })),
        }
        Ok(self.line.rest().to_owned())
    }

    /// Ends a section. Returns an error if it had another number of entries than it announced, of which `found` have been read.
    pub(super) fn end(
        &mut self,
        section: &str,
        what: &'static str,
        announced: usize,
        mut found: usize,
    ) -> Result<(), MeshError> {
        if self.is_binary {
            self.skip_blanks();
            let end = format!("$End{section}");
            if !self.rest().starts_with(end.as_bytes()) {
                return Err(self.error(Problem::Malformed { reason: format!("`{end}` should stand here") }));
            }
            self.rest_of_line();
        } else {
            let is_end = |line: &Words| line.peek().is_some_and(|word| word.starts_with('$'));
            found += self.lines.by_ref().take_while(|line| !is_end(line)).count();
        }
        if found == announced {
            return Ok(());
        }
        Err(MeshError::in_file(self.file, Problem::WrongCount { what, announced, found }))
    }

    /// The error of a problem at this place of the file.
    pub(super) fn error(&self, problem: Problem) -> MeshError {
        if self.is_binary { MeshError::in_byte(self.file, self.at, problem) } else { self.line.error(problem) }
    }

    /// A count, of 8 bytes in a binary file. Never allocate by it: the file may hold less.
    pub(super) fn count(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        let count = self.long(expected)?;
        self.not_negative(count, expected)
    }

    /// A count, of 4 bytes in a binary file.
    pub(super) fn amount(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        let count = self.int(expected)?;
        self.not_negative(count, expected)
    }

    fn not_negative(&self, count: i64, expected: &'static str) -> Result<usize, MeshError> {
        usize::try_from(count).map_err(|_| self.error(Problem::NotA { word: count.to_string(), expected }))
    }

    /// A count on a line of its own, which is text in binary files too.
    pub(super) fn text_count(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        let line = self.text_line(expected)?;
        line.trim().parse().map_err(|_| self.error(Problem::NotA { word: line.trim().to_owned(), expected }))
    }
}
