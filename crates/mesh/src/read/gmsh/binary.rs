//! Binary files: little-endian numbers between lines of text.

use std::path::Path;

use nalgebra::Vector3;

use super::numbers::Numbers;
use crate::{MeshError, Problem};

/// The bytes of a file, from a position on.
pub(super) struct Binary<'a> {
    file: &'a Path,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Binary<'a> {
    pub(super) fn new(file: &'a Path, bytes: &'a [u8], at: usize) -> Self {
        Self { file, bytes, at }
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
        match self.rest().first_chunk() {
            Some(chunk) => {
                self.at += N;
                Ok(*chunk)
            }
            None => Err(self.error(Problem::Ends { expected })),
        }
    }

    fn malformed(&self, reason: String) -> MeshError {
        self.error(Problem::Malformed { reason })
    }
}

impl Numbers for Binary<'_> {
    fn section(&mut self) -> Result<Option<String>, MeshError> {
        self.skip_blanks();
        if self.rest().is_empty() {
            return Ok(None);
        }
        if self.rest()[0] != b'$' {
            return Err(self.malformed("a section should begin here with `$`".to_owned()));
        }
        let line = String::from_utf8_lossy(self.rest_of_line());
        Ok(Some(line.trim().trim_start_matches('$').to_owned()))
    }

    fn skip(&mut self, section: &str) -> Result<(), MeshError> {
        let end = format!("$End{section}");
        let found = self.rest().windows(end.len()).position(|window| window == end.as_bytes());
        self.at +=
            found.ok_or_else(|| self.error(Problem::Ends { expected: "the end of the last section" }))? + end.len();
        Ok(())
    }

    fn row(&mut self, _: &'static str, _: usize, _: usize) -> Result<(), MeshError> {
        Ok(())
    }

    fn end_row(&self, _: &'static str) -> Result<(), MeshError> {
        Ok(())
    }

    fn int(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        self.take(expected).map(|bytes| i32::from_le_bytes(bytes).into())
    }

    fn long(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        self.take(expected).map(i64::from_le_bytes)
    }

    fn real(&mut self, expected: &'static str) -> Result<f64, MeshError> {
        self.take(expected).map(f64::from_le_bytes)
    }

    fn place(&mut self) -> Result<Vector3<f64>, MeshError> {
        let mut place = Vector3::zeros();
        for i in 0..3 {
            let at = self.at;
            place[i] = self.real("a coordinate")?;
            if !place[i].is_finite() {
                let problem = Problem::NotFinite { word: place[i].to_string() };
                return Err(MeshError::in_byte(self.file, at, problem));
            }
        }
        Ok(place)
    }

    fn text_line(&mut self, expected: &'static str) -> Result<String, MeshError> {
        if self.rest().is_empty() {
            return Err(self.error(Problem::Ends { expected }));
        }
        Ok(String::from_utf8_lossy(self.rest_of_line()).into_owned())
    }

    fn end(&mut self, section: &str, what: &'static str, announced: usize, found: usize) -> Result<(), MeshError> {
        self.skip_blanks();
        let end = format!("$End{section}");
        if !self.rest().starts_with(end.as_bytes()) {
            return Err(self.malformed(format!("`{end}` should stand here")));
        }
        self.rest_of_line();
        if found == announced {
            return Ok(());
        }
        Err(MeshError::in_file(self.file, Problem::WrongCount { what, announced, found }))
    }

    fn error(&self, problem: Problem) -> MeshError {
        MeshError::in_byte(self.file, self.at, problem)
    }
}
