//! The lines of an input file: keywords with parameters, and rows of data between commas, over included files.

use std::path::{Path, PathBuf};

use super::super::text;
use crate::{MeshError, Problem};

/// Files that include one another, beyond which they are taken to include themselves.
const DEEPEST: usize = 16;

/// A line of a file.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    file: &'a Path,
    number: usize,
    text: &'a str,
}

/// A line that begins with `*`: its keyword in capitals, and its parameters.
pub(super) struct Keyword<'a> {
    pub line: Line<'a>,
    pub name: String,
    parameters: Vec<(String, String)>,
}

/// The text of a file with those that it includes, in their place.
pub(super) struct Deck {
    /// File, number of the first line, and lines.
    parts: Vec<(PathBuf, usize, String)>,
}

impl Deck {
    /// Reads the files that `file` includes; their paths count from its folder.
    pub(super) fn read(file: &Path, content: String) -> Result<Self, MeshError> {
        let mut deck = Self { parts: Vec::new() };
        deck.add(file, content, 0)?;
        Ok(deck)
    }

    fn add(&mut self, file: &Path, content: String, depth: usize) -> Result<(), MeshError> {
        let (mut start, mut at) = ((1, 0), 0);
        for (i, line) in content.split_inclusive('\n').enumerate() {
            at += line.len();
            let keyword = Line { file, number: i + 1, text: line.trim() }.keyword();
            let Some(keyword) = keyword.filter(|keyword| keyword.name == "INCLUDE") else { continue };
            let input = keyword.required("INPUT")?;
            if depth == DEEPEST {
                let found = format!("a file that is included {DEEPEST} times deep");
                return Err(keyword
                    .line
                    .error(Problem::Unsupported { found, instead: "remove the circle of *INCLUDE" }));
            }
            self.parts.push((file.to_owned(), start.0, content[start.1..at - line.len()].to_owned()));
            let path = file.with_file_name(input);
            self.add(&path, text(&path)?, depth + 1)?;
            start = (i + 2, at);
        }
        let rest = if start.1 == 0 { content } else { content[start.1..].to_owned() };
        self.parts.push((file.to_owned(), start.0, rest));
        Ok(())
    }

    /// All lines that are neither empty nor comments.
    pub(super) fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        let lines = self.parts.iter().flat_map(|(file, first, content)| {
            content.lines().enumerate().map(move |(i, text)| Line { file, number: first + i, text: text.trim() })
        });
        lines.filter(|line| !line.text.is_empty() && !line.text.starts_with("**"))
    }
}

impl<'a> Line<'a> {
    pub(super) fn error(&self, problem: Problem) -> MeshError {
        MeshError::in_line(self.file, self.number, problem)
    }

    pub(super) fn is_keyword(&self) -> bool {
        self.text.starts_with('*')
    }

    pub(super) fn keyword(self) -> Option<Keyword<'a>> {
        let mut words = self.text.strip_prefix('*').filter(|rest| !rest.starts_with('*'))?.split(',');
        let name = words.next().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ").to_uppercase();
        let parameter = |word: &str| {
            let (key, value) = word.split_once('=').unwrap_or((word, ""));
            (key.trim().to_uppercase(), value.trim().trim_matches('"').to_owned())
        };
        let parameters = words.map(parameter).filter(|(key, _)| !key.is_empty()).collect();
        Some(Keyword { line: self, name, parameters })
    }

    /// The entries of a row of data. A comma at its end is no entry.
    pub(super) fn entries(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        self.text.strip_suffix(',').unwrap_or(self.text).split(',').map(str::trim)
    }

    /// Returns true if the row goes on in the next line.
    pub(super) fn goes_on(&self) -> bool {
        self.text.ends_with(',')
    }

    pub(super) fn integer(&self, word: &str, expected: &'static str) -> Result<i64, MeshError> {
        word.parse().map_err(|_| self.error(Problem::NotA { word: word.to_owned(), expected }))
    }

    /// An entry as a finite number, which may have the exponent of Fortran; an empty one is 0.
    pub(super) fn real(&self, word: &str) -> Result<f64, MeshError> {
        let number = if word.is_empty() { Ok(0.0) } else { word.replace(['d', 'D'], "e").parse() };
        let expected = "a coordinate, which is a number";
        let number: f64 = number.map_err(|_| self.error(Problem::NotA { word: word.to_owned(), expected }))?;
        if number.is_finite() { Ok(number) } else { Err(self.error(Problem::NotFinite { word: word.to_owned() })) }
    }
}

impl Keyword<'_> {
    /// The value of a parameter, empty if it has none.
    pub(super) fn parameter(&self, key: &str) -> Option<&str> {
        self.parameters.iter().find(|(found, _)| found == key).map(|(_, value)| &value[..])
    }

    pub(super) fn required(&self, key: &'static str) -> Result<&str, MeshError> {
        self.parameter(key)
            .filter(|value| !value.is_empty())
            .ok_or_else(|| self.line.error(Problem::Ends { expected: key }))
    }
}
