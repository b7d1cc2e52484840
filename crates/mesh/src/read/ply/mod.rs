//! Polygon files, text and binary. Source: G. Turk, The PLY Polygon File Format (1994).

mod header;

use std::path::Path;

use nalgebra::Vector3;

use self::header::{Element, Encoding, Kind, Property, header};
use super::content::Content;
use super::words::from_zero;
use crate::{MeshError, Problem};

/// Properties of a face that hold the indices of its corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Reads `x`, `y` and `z` of each `vertex`, and the indices of each `face` and of each strip of `tristrips`. Polygons become fans.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Content, MeshError> {
    let mut reader = Reader::new(file, bytes);
    let elements = header(&mut reader)?;
    let mut content = Content { is_surface: true, ..Content::default() };
    let mut corners: Vec<[f64; 3]> = Vec::new();
    for element in &elements {
        tell_unread(&mut content, element);
        // Entries without properties would take no bytes, and any number of them no time to announce.
        for _ in 0..if element.properties.is_empty() { 0 } else { element.count } {
            match &element.name[..] {
                "vertex" => content.vertices.push(vertex(&mut reader, element)?),
                "face" => {
                    let polygon = indices(&mut reader, element)?;
                    content.short_faces += usize::from(polygon.len() < 3);
                    add_fan(&polygon, &mut corners);
                }
                "tristrips" => add_strips(&indices(&mut reader, element)?, &mut corners),
                _ => entry(&mut reader, element, |_, _| ())?,
            }
        }
        if let Some(line) = reader.longer_rows() {
            let (name, last) = (&element.name, element.properties.last().map_or("", |last| &last.name));
            content.notes.tell(format!(
                "the rows of `{name}` are longer than the header says, the first in line {line}; what stands after `{last}` is not read"
            ));
        }
    }
    reader.end()?;
    // Indices are checked at the end: faces may stand before the vertices.
    content.triangles.reserve_exact(corners.len());
    for corners in corners {
        let corner = |index: f64| match index.fract() == 0.0 {
            true => from_zero(index as i64, 0, content.vertices.len()),
            false => Err(Problem::NotA { word: index.to_string(), expected: "the index of a vertex" }),
        };
        let [a, b, c] = corners.map(|index| corner(index).map_err(|problem| MeshError::in_file(file, problem)));
        content.triangles.push([a?, b?, c?]);
    }
    Ok(content)
}

/// Names the properties and elements that are not read.
fn tell_unread(content: &mut Content, element: &Element) {
    let known: &[&str] = match &element.name[..] {
        "vertex" => &["x", "y", "z"],
        "face" | "tristrips" => &CORNERS,
        other => return content.notes.unread(format!("the element `{other}`")),
    };
    for Property { name, .. } in element.properties.iter().filter(|property| !known.contains(&&property.name[..])) {
        content.notes.unread(format!("`{name}` of {}", element.name));
    }
}

/// Adds a polygon as triangles around its first corner; one of fewer than three corners has none.
fn add_fan(corners: &[f64], triangles: &mut Vec<[f64; 3]>) {
    if let [first, rest @ ..] = corners {
        triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
}

/// Adds strips of triangles, which a negative number ends. Every second triangle of a strip is turned.
fn add_strips(corners: &[f64], triangles: &mut Vec<[f64; 3]>) {
    for strip in corners.split(|&index| index < 0.0) {
        let turned = |(i, corners): (usize, &[f64])| match i % 2 {
            0 => [corners[0], corners[1], corners[2]],
            _ => [corners[1], corners[0], corners[2]],
        };
        triangles.extend(strip.windows(3).enumerate().map(turned));
    }
}

fn vertex(reader: &mut Reader, element: &Element) -> Result<Vector3<f64>, MeshError> {
    let mut place = Vector3::repeat(f64::NAN);
    entry(reader, element, |property, numbers| {
        if let (Some(i), Some(number)) = (["x", "y", "z"].iter().position(|name| *name == property), numbers.first()) {
            place[i] = *number;
        }
    })?;
    if place.iter().all(|x| x.is_finite()) {
        return Ok(place);
    }
    Err(reader.error(Problem::NotFinite { word: format!("{:?}", <[f64; 3]>::from(place)) }))
}

/// The indices of a face or of strips.
fn indices(reader: &mut Reader, element: &Element) -> Result<Vec<f64>, MeshError> {
    let mut corners = Vec::new();
    entry(reader, element, |property, numbers| {
        if CORNERS.contains(&property) {
            corners = numbers.to_vec();
        }
    })?;
    Ok(corners)
}

/// Reads one entry, and hands over the numbers of each of its properties.
fn entry(reader: &mut Reader, element: &Element, mut take: impl FnMut(&str, &[f64])) -> Result<(), MeshError> {
    reader.begin_row();
    let mut numbers = Vec::new();
    for Property { name, length, kind } in &element.properties {
        let length = match length {
            None => 1,
            Some(kind) => {
                let length = reader.number(*kind)?;
                if !(length >= 0.0 && length.fract() == 0.0) {
                    let word = length.to_string();
                    return Err(reader.error(Problem::NotA { word, expected: "the length of a list" }));
                }
                length as usize
            }
        };
        numbers.clear();
        for _ in 0..length {
            numbers.push(reader.number(*kind)?);
        }
        take(name, &numbers);
    }
    reader.end_row(element.count)
}

/// A place in the file.
struct Reader<'a> {
    file: &'a Path,
    bytes: &'a [u8],
    at: usize,
    /// Number of line ends before that place, as long as the file is text.
    line: usize,
    encoding: Encoding,
    /// Line of the current row of text.
    row: usize,
    /// Whether all rows of the element so far are longer than they should be; `None` before the first. The line of the first.
    are_longer: Option<bool>,
    first_row: usize,
}

impl<'a> Reader<'a> {
    fn new(file: &'a Path, bytes: &'a [u8]) -> Self {
        Self { file, bytes, at: 0, line: 0, encoding: Encoding::Text, row: 0, are_longer: None, first_row: 0 }
    }

    fn error(&self, problem: Problem) -> MeshError {
        match self.encoding {
            Encoding::Text => MeshError::in_line(self.file, self.line.max(1), problem),
            _ => MeshError::in_byte(self.file, self.at, problem),
        }
    }

    fn header_line(&mut self) -> Result<String, MeshError> {
        let rest = &self.bytes[self.at..];
        let Some(end) = rest.iter().position(|&byte| byte == b'\n') else {
            return Err(self.error(Problem::Ends { expected: "the line `end_header`" }));
        };
        self.at += end + 1;
        self.line += 1;
        Ok(String::from_utf8_lossy(&rest[..end]).into_owned())
    }

    fn number(&mut self, kind: Kind) -> Result<f64, MeshError> {
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
    fn begin_row(&mut self) {
        if self.is_text() {
            self.skip_blanks();
            self.row = self.line;
        }
    }

    /// Ends a row of a text. If the header forgets a property, every row is longer than it says; a single longer row is an error.
    fn end_row(&mut self, rows: usize) -> Result<(), MeshError> {
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
    fn longer_rows(&mut self) -> Option<usize> {
        self.are_longer.take().filter(|are_longer| *are_longer).map(|_| self.first_row)
    }

    /// Ends the file, in which nothing may be left.
    fn end(&mut self) -> Result<(), MeshError> {
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
