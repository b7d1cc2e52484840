//! A VTK file as words, lines and arrays.

use std::path::Path;

use crate::{MeshError, Problem};

/// The rest of a file: words and lines of text, and arrays as text or as big-endian numbers.
#[derive(Clone)]
pub(super) struct Reader<'a> {
    file: &'a Path,
    bytes: &'a [u8],
    at: usize,
    pub(super) is_binary: bool,
}

impl<'a> Reader<'a> {
    /// All of a file, as text until its header says otherwise.
    pub(super) fn new(file: &'a Path, bytes: &'a [u8]) -> Self {
        Self { file, bytes, at: 0, is_binary: false }
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// The line of the last word in a text file, the byte after it in a binary one.
    pub(super) fn error(&self, problem: Problem) -> MeshError {
        if self.is_binary {
            return MeshError::in_byte(self.file, self.at, problem);
        }
        let line = 1 + self.bytes[..self.at].iter().filter(|&&byte| byte == b'\n').count();
        MeshError::in_line(self.file, line, problem)
    }

    pub(super) fn malformed(&self, reason: String) -> MeshError {
        self.error(Problem::Malformed { reason })
    }

    pub(super) fn word(&mut self) -> Option<String> {
        let blanks = self.rest().iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let word = self.rest()[blanks..].split(|byte| byte.is_ascii_whitespace()).next().unwrap_or_default();
        self.at += blanks + word.len();
        (!word.is_empty()).then(|| String::from_utf8_lossy(word).into_owned())
    }

    /// Takes the next word if it is this keyword.
    pub(super) fn takes(&mut self, keyword: &str) -> bool {
        let mut ahead = self.clone();
        let is_next = ahead.word().is_some_and(|word| word.eq_ignore_ascii_case(keyword));
        self.at = if is_next { ahead.at } else { self.at };
        is_next
    }

    pub(super) fn expected(&mut self, expected: &'static str) -> Result<String, MeshError> {
        self.word().ok_or_else(|| self.error(Problem::Ends { expected }))
    }

    /// Never allocate by a count: the file may hold less.
    pub(super) fn count(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        let word = self.expected(expected)?;
        word.parse().map_err(|_| self.error(Problem::NotA { word, expected }))
    }

    pub(super) fn line(&mut self) -> String {
        let line = self.rest().split(|&byte| byte == b'\n').next().unwrap_or_default();
        self.at = (self.at + line.len() + 1).min(self.bytes.len());
        String::from_utf8_lossy(line).trim_end().to_owned()
    }

    /// Skips up to the next empty line.
    pub(super) fn skip_paragraph(&mut self) {
        self.line();
        while !self.rest().is_empty() && !self.line().is_empty() {}
    }

    pub(super) fn skip_array(&mut self, count: usize, kind: &str) -> Result<(), MeshError> {
        match kind {
            "string" => self.skip_strings(count),
            _ if !self.is_binary => (0..count).try_for_each(|_| self.expected("an entry of a field").map(drop)),
            "float" | "double" => self.reals(count, kind).map(drop),
            "bit" => self.numbers(count.div_ceil(8), |[byte]: [u8; 1]| byte).map(drop),
            _ => self.integers(count, kind).map(drop),
        }
    }

    /// Strings: a line each in text; in a binary file each after its length, whose first two bits tell the bytes that it takes.
    fn skip_strings(&mut self, count: usize) -> Result<(), MeshError> {
        self.line();
        for _ in 0..count {
            let ends = self.malformed("an array of strings is cut short".to_owned());
            let &first = self.rest().first().ok_or(ends.clone())?;
            if !self.is_binary {
                self.line();
                continue;
            }
            let width = [8, 4, 2, 1][usize::from(first >> 6)];
            let bytes = self.rest().get(..width).ok_or(ends.clone())?;
            let length = bytes.iter().fold(0_u64, |length, &byte| length << 8 | u64::from(byte));
            let length = usize::try_from(length & (u64::MAX >> (64 - 8 * width + 2))).unwrap_or(usize::MAX);
            let end = width.saturating_add(length);
            self.rest().get(..end).ok_or(ends)?;
            self.at += end;
        }
        Ok(())
    }

    pub(super) fn reals(&mut self, count: usize, kind: &str) -> Result<Vec<f64>, MeshError> {
        match kind {
            _ if !self.is_binary => self.words(count, "a number"),
            "float" => self.numbers(count, |bytes| f32::from_be_bytes(bytes).into()),
            "double" => self.numbers(count, f64::from_be_bytes),
            _ => Err(self.unsupported_type(kind)),
        }
    }

    pub(super) fn integers(&mut self, count: usize, kind: &str) -> Result<Vec<i64>, MeshError> {
        match kind {
            _ if !self.is_binary => self.words(count, "an integer"),
            "char" | "signed_char" | "unsigned_char" => self.numbers(count, |[byte]| byte.into()),
            "short" | "vtktypeint16" => self.numbers(count, |bytes| i16::from_be_bytes(bytes).into()),
            "unsigned_short" | "vtktypeuint16" => self.numbers(count, |bytes| u16::from_be_bytes(bytes).into()),
            "int" | "vtkIdType" | "vtktypeint32" => self.numbers(count, |bytes| i32::from_be_bytes(bytes).into()),
            "unsigned_int" | "vtktypeuint32" => self.numbers(count, |bytes| u32::from_be_bytes(bytes).into()),
            // A number that does not fit becomes a negative one, which is no index either.
            "long" | "unsigned_long" | "vtktypeint64" | "vtktypeuint64" | "unsigned_vtktypeint64" => {
                self.numbers(count, i64::from_be_bytes)
            }
            _ => Err(self.unsupported_type(kind)),
        }
    }

    fn unsupported_type(&self, kind: &str) -> MeshError {
        let found = format!("an array of the type {kind}");
        self.error(Problem::Unsupported {
            found,
            instead: "use float or double for points, int or vtktypeint64 for cells",
        })
    }

    fn words<T: std::str::FromStr>(&mut self, count: usize, expected: &'static str) -> Result<Vec<T>, MeshError> {
        // At most twice the rest of the file, independent of the count.
        let mut values = Vec::with_capacity(count.min(self.rest().len() / 4));
        for _ in 0..count {
            let word = self.expected(expected)?;
            values.push(word.parse().map_err(|_| self.error(Problem::NotA { word, expected }))?);
        }
        Ok(values)
    }

    /// Numbers after the end of the line.
    fn numbers<T, const N: usize>(&mut self, count: usize, number: impl Fn([u8; N]) -> T) -> Result<Vec<T>, MeshError> {
        self.line();
        let array = count.checked_mul(N).and_then(|length| self.rest().get(..length)).ok_or_else(|| {
            self.malformed(format!(
                "an array of {count} numbers of {N} bytes is cut short: {} bytes are left",
                self.rest().len()
            ))
        })?;
        self.at += array.len();
        Ok(array.as_chunks().0.iter().map(|&chunk| number(chunk)).collect())
    }
}

/// Returns true for VTK's names of integer types.
pub(super) fn is_integer(kind: &str) -> bool {
    !["float", "double", "string", "bit", "variant", "utf8_string"].contains(&kind)
}
