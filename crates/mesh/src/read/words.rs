//! A text file as words with their line numbers.

use std::path::Path;
use std::str::FromStr;

use nalgebra::Vector3;

use crate::{MeshError, Problem};

/// The rest of a text, as words between blanks and line ends. A word that starts with `#` begins a comment.
#[derive(Clone)]
pub(super) struct Words<'a> {
    file: &'a Path,
    line: usize,
    rest: &'a str,
}

impl<'a> Words<'a> {
    /// All words of a text, across its lines.
    pub(super) fn of_text(file: &'a Path, text: &'a str) -> Self {
        Self { file, line: 1, rest: text }
    }

    /// The words of one line; `line` is its number, counted from 1.
    pub(super) fn of_line(file: &'a Path, line: usize, text: &'a str) -> Self {
        Self { file, line, rest: text }
    }

    /// The words of each line that has any.
    pub(super) fn of_lines(file: &'a Path, text: &'a str) -> impl Iterator<Item = Self> {
        let lines = text.lines().enumerate().map(move |(i, rest)| Self { file, line: i + 1, rest });
        lines.filter(|line| line.peek().is_some())
    }

    /// The next word, without taking it.
    pub(super) fn peek(&self) -> Option<&'a str> {
        self.clone().next()
    }

    /// Line of the last word, counted from 1.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// The error of a problem in that line.
    pub(super) fn error(&self, problem: Problem) -> MeshError {
        MeshError::in_line(self.file, self.line, problem)
    }

    /// The next word; `expected` describes it in the message if it is missing.
    pub(super) fn word(&mut self, expected: &'static str) -> Result<&'a str, MeshError> {
        self.next().ok_or_else(|| self.error(Problem::Ends { expected }))
    }

    fn parse<T: FromStr>(&mut self, expected: &'static str) -> Result<T, MeshError> {
        let word = self.word(expected)?;
        word.parse().map_err(|_| self.error(Problem::NotA { word: word.to_owned(), expected }))
    }

    /// The next word as an integer.
    pub(super) fn integer(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        self.parse(expected)
    }

    /// The next word as a tag: an integer, which some programs write as `0.0`.
    pub(super) fn tag(&mut self, expected: &'static str) -> Result<i32, MeshError> {
        let word = self.word(expected)?;
        let of_real = || word.parse().ok().filter(|x: &f64| x.fract() == 0.0 && x.abs() < 2e9).map(|x| x as i32);
        let found = word.parse().ok().or_else(of_real);
        found.ok_or_else(|| self.error(Problem::NotA { word: word.to_owned(), expected }))
    }

    /// The next word as a count. Never allocate by it: the file may hold less.
    pub(super) fn amount(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        self.parse(expected)
    }

    /// The next word as an index between `first` and `first + count − 1`; returned as counted from 0.
    pub(super) fn index(&mut self, first: i64, count: usize) -> Result<usize, MeshError> {
        let index = self.integer("the index of a vertex")?;
        from_zero(index, first, count).map_err(|problem| self.error(problem))
    }

    /// The next word as a number.
    pub(super) fn real(&mut self, expected: &'static str) -> Result<f64, MeshError> {
        self.parse(expected)
    }

    /// Ends the row: no word may be left after the last one, which `last` describes.
    pub(super) fn end(&self, last: &'static str) -> Result<(), MeshError> {
        match self.peek() {
            None => Ok(()),
            Some(word) => Err(self.error(Problem::RowTooLong { word: word.to_owned(), last })),
        }
    }

    /// All that is left.
    pub(super) fn rest(&self) -> &'a str {
        self.rest
    }

    /// The next three words as a finite position.
    pub(super) fn place(&mut self) -> Result<Vector3<f64>, MeshError> {
        Ok(Vector3::new(self.coordinate()?, self.coordinate()?, self.coordinate()?))
    }

    /// The next two words as a finite position in the plane z = 0.
    pub(super) fn place_in_plane(&mut self) -> Result<Vector3<f64>, MeshError> {
        Ok(Vector3::new(self.coordinate()?, self.coordinate()?, 0.0))
    }

    /// The next word as a finite coordinate.
    pub(super) fn coordinate(&mut self) -> Result<f64, MeshError> {
        let start = self.clone();
        let value: f64 = self.parse("a coordinate, which is a number")?;
        let word = || start.peek().unwrap_or_default().to_owned();
        if value.is_finite() { Ok(value) } else { Err(self.error(Problem::NotFinite { word: word() })) }
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        loop {
            let start = self.rest.find(|c: char| !c.is_whitespace())?;
            let (blank, rest) = self.rest.split_at(start);
            self.line += blank.bytes().filter(|&byte| byte == b'\n').count();
            let is_end: fn(char) -> bool = if rest.starts_with('#') { |c| c == '\n' } else { char::is_whitespace };
            let (word, rest) = rest.split_at(rest.find(is_end).unwrap_or(rest.len()));
            self.rest = rest;
            if !word.starts_with('#') {
                return Some(word);
            }
        }
    }
}

/// A file's vertex index, counted from `first`, as an index from 0.
pub(super) fn from_zero(index: i64, first: i64, count: usize) -> Result<usize, Problem> {
    let from_zero = index.checked_sub(first).and_then(|i| usize::try_from(i).ok()).filter(|&i| i < count);
    from_zero.ok_or_else(|| match count {
        0 => Problem::NoVertices { index },
        _ => Problem::OutOfRange { index, first, last: first + count as i64 - 1 },
    })
}

/// Reads exactly the announced number of lines, one entry each; a line that starts with `$` ends them. No more may follow.
pub(super) fn rows<'a, R>(
    file: &Path,
    mut lines: impl Iterator<Item = Words<'a>>,
    what: &'static str,
    announced: usize,
    mut row: impl FnMut(usize, &mut Words<'a>) -> Result<R, MeshError>,
) -> Result<Vec<R>, MeshError> {
    let mut entries = Vec::new();
    let wrong = |found| Err(MeshError::in_file(file, Problem::WrongCount { what, announced, found }));
    while entries.len() < announced {
        match lines.next().filter(|line| !line.rest.trim_start().starts_with('$')) {
            Some(mut line) => entries.push(row(entries.len(), &mut line)?),
            None => return wrong(entries.len()),
        }
    }
    match lines.count() {
        0 => Ok(entries),
        more => wrong(announced + more),
    }
}
