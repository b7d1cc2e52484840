//! A polygon file as lines and numbers.

use std::path::Path;

use super::number::{Encoding, Kind};
use crate::{MeshError, Problem};

/// A place in the file.
pub(super) struct Reader<'a> {
    file: &'a Path,
    bytes: &'a [u8],
    at: usize,
    /// Number of line ends before that place, as long as the file is text.
    line: usize,
    pub(super) encoding: Encoding,
    /// Line of the current row of text.
    row: usize,
    /// Whether all rows of the element so far are longer than they should be; `None` before the first. The line of the first.
    are_longer: Option<bool>,
    first_row: usize,
}

impl<'a> Reader<'a> {
    pub(super) fn new(file: &'a Path, bytes: &'a [u8]) -> Self {
        Self { file, bytes, at: 0, line: 0, encoding: Encoding::Text, row: 0, are_longer: None, first_row: 0 }
    }

    pub(super) fn error(&self, problem: Problem) -> MeshError {
        match self.encoding {
            Encoding::Text => MeshError::in_line(self.file, self.line.max(1), problem),
            _ => MeshError::in_byte(self.file, self.at, problem),
        }
    }

    pub(super) fn header_line(&mut self) -> Result<String, MeshError> {
        let rest = &self.bytes[self.at..];
        let Some(end) = rest.iter().position(|&byte| byte == b'\n') else {
            return Err(self.error(Problem::Ends { expected: "the line `end_header`" }));
        };
        self.at += end + 1;
        self.line += 1;
        Ok(String::from_utf8_lossy(&rest[..end]).into_owned())
    }

    pub(super) fn number(&mut self, kind: Kind) -> Result<f64, MeshError> {
        if self.is_text() {
            return self.word();
        }
        let Some(bytes) = self.bytes.get(self.at..self.at + kind.bytes()) else {
            return Err(self.error(Problem::Ends { expected: "a number" }));
        };
        self.at += bytes.len();
        let mut number = [0; 8];
        number[..bytes.len()].copy_from_slice(bytes);
        if self.encoding == Encoding::BigEndian {
            number[..bytes.len()].reverse();
        }
        Ok(kind.number(number))
    }

    fn is_text(&self) -> bool {
        self.encoding == Encoding::Text
    }

    /// Skips blanks, and ends of lines in text.
    fn skip_blanks(&mut self) {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            // The header ended with a line end, which counted its own line.
            self.line += usize::from(*byte == b'\n');
            self.at += 1;
        }
    }

    /// Begins a row of an element, which is a line of a text.
    pub(super) fn begin_row(&mut self) {
        if self.is_text() {
            self.skip_blanks();
            self.row = self.line;
        }
    }

    /// Ends a row of a text. If the header forgets a property, every row is longer than it says; a single longer row is an error.
    pub(super) fn end_row(&mut self, rows: usize) -> Result<(), MeshError> {
        if !self.is_text() {
            return Ok(());
        }
        let rest = self.bytes[self.at..].split(|&byte| byte == b'\n').next().unwrap_or_default();
        let word = rest.trim_ascii().split(u8::is_ascii_whitespace).next().unwrap_or_default();
        let is_longer = !word.is_empty();
        if self.are_longer.is_none() {
            self.first_row = self.line + 1;
        }
        if *self.are_longer.get_or_insert(is_longer && rows > 1) != is_longer {
            let word = String::from_utf8_lossy(if is_longer { word } else { b"the end of the line" }).into_owned();
            let last = if is_longer { "the last property of the header" } else { "this row but not after the others" };
            let problem = Problem::RowTooLong { word, last };
            return Err(MeshError::in_line(self.file, self.line + 1, problem));
        }
        self.at += rest.len();
        Ok(())
    }

    /// Ends an element. Returns the line of its first row if all rows were longer than the header says.
    pub(super) fn longer_rows(&mut self) -> Option<usize> {
        self.are_longer.take().filter(|are_longer| *are_longer).map(|_| self.first_row)
    }

    /// Ends the file, in which nothing may be left.
    pub(super) fn end(&mut self) -> Result<(), MeshError> {
        if self.is_text() {
            self.skip_blanks();
        }
        let rest = &self.bytes[self.at..];
        if rest.iter().all(|byte| byte.is_ascii_whitespace() || *byte == 0) {
            return Ok(());
        }
        let reason = format!("{} bytes are left after the last element that the header announces", rest.len());
        Err(match self.is_text() {
            true => MeshError::in_line(self.file, self.line + 1, Problem::Malformed { reason }),
            false => self.error(Problem::Malformed { reason }),
        })
    }

    /// The next word of the row.
    fn word(&mut self) -> Result<f64, MeshError> {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if end == 0 || self.line > self.row {
            let problem = Problem::Ends { expected: "a number" };
            return Err(MeshError::in_line(self.file, self.row + 1, problem));
        }
        let word = String::from_utf8_lossy(&rest[..end]);
        let number = word.parse();
        let wrong = |_| {
            let problem = Problem::NotA { word: word.chars().take(40).collect(), expected: "a number" };
            MeshError::in_line(self.file, self.line + 1, problem)
        };
        let number = number.map_err(wrong)?;
        self.at += end;
        Ok(number)
    }
}
