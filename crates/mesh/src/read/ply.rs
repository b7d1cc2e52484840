//! Polygon files, text and binary. Source: G. Turk, The PLY Polygon File Format (1994).

use std::path::Path;

use nalgebra::Vector3;

use super::words::from_zero;
use crate::{MeshError, Problem, SurfaceMesh};

/// A number's type in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The number that begins these bytes, the least significant first.
    fn number(self, bytes: [u8; 8]) -> f64 {
        let [a, b, c, d, ..] = bytes;
        match self {
            Self::I8 => f64::from(a as i8),
            Self::U8 => f64::from(a),
            Self::I16 => f64::from(i16::from_le_bytes([a, b])),
            Self::U16 => f64::from(u16::from_le_bytes([a, b])),
            Self::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Self::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Self::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Self::F64 => f64::from_le_bytes(bytes),
        }
    }
}

/// A property of the entries of an element: its name, the type of its length if it is a list, and that of its numbers.
struct Property {
    name: String,
    length: Option<Kind>,
    kind: Kind,
}

/// A kind of entry, such as `vertex`, with their number.
struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// Reads `x`, `y` and `z` of each `vertex` and the indices of each `face`; colours, normals and other elements do not change the shape.
/// Polygons become fans; a triangle that names a vertex twice has no area and is left out.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<SurfaceMesh, MeshError> {
    let mut reader = Reader { file, bytes, at: 0, line: 0, encoding: Encoding::Text };
    let elements = header(&mut reader)?;
    let (mut vertices, mut fans) = (Vec::new(), Vec::new());
    for element in &elements {
        for _ in 0..element.count {
            match &element.name[..] {
                "vertex" => vertices.push(vertex(&mut reader, element)?),
                "face" => add_fan(&polygon(&mut reader, element)?, &mut fans),
                _ => entry(&mut reader, element, |_, _| ())?,
            }
        }
    }
    if fans.is_empty() {
        return Err(MeshError::in_file(file, Problem::Empty { what: "faces" }));
    }
    // Indices are checked at the end: faces may stand before the vertices.
    let mut triangles = Vec::with_capacity(fans.len());
    for corners in fans {
        let corner = |index: f64| match index.fract() == 0.0 {
            true => from_zero(index as i64, 0, vertices.len()),
            false => Err(Problem::NotA { word: index.to_string(), expected: "the index of a vertex" }),
        };
        let [a, b, c] = corners.map(|index| corner(index).map_err(|problem| MeshError::in_file(file, problem)));
        let (a, b, c) = (a?, b?, c?);
        if a != b && b != c && c != a {
            triangles.push([a, b, c]);
        }
    }
    Ok(SurfaceMesh::new(vertices, triangles))
}

/// Adds a polygon as triangles around its first corner; one of fewer than three corners has none.
fn add_fan(corners: &[f64], fans: &mut Vec<[f64; 3]>) {
    if let [first, rest @ ..] = corners {
        fans.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
}

/// The lines from `ply` to `end_header`.
fn header(reader: &mut Reader) -> Result<Vec<Element>, MeshError> {
    if reader.header_line()?.trim() != "ply" {
        let found = "a .ply file that does not begin with `ply`".to_owned();
        return Err(reader.error(Problem::Unsupported { found, instead: "export the surface as .ply again" }));
    }
    let mut elements: Vec<Element> = Vec::new();
    let mut encoding = None;
    loop {
        let line = reader.header_line()?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let not_understood = |reader: &Reader| {
            let expected = "a line of a .ply header: format, comment, element, property or end_header";
            reader.error(Problem::NotA { word: line.trim().to_owned(), expected })
        };
        match &words[..] {
            ["format", name, _] => {
                encoding = Some(match *name {
                    "ascii" => Encoding::Text,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => return Err(not_understood(reader)),
                });
            }
            ["comment" | "obj_info", ..] | [] => {}
            ["element", name, count] => {
                let count = count.parse().map_err(|_| not_understood(reader))?;
                elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new() });
            }
            ["property", rest @ ..] => {
                let property = property(rest).ok_or_else(|| not_understood(reader))?;
                elements.last_mut().ok_or_else(|| not_understood(reader))?.properties.push(property);
            }
            ["end_header"] => break,
            _ => return Err(not_understood(reader)),
        }
    }
    let expected = "the line `format …` of the header";
    reader.encoding = encoding.ok_or_else(|| reader.error(Problem::Ends { expected }))?;
    // Entries without properties would take no bytes, and any number of them no time to announce.
    elements.retain(|element| !element.properties.is_empty());
    Ok(elements)
}

/// `<type> <name>` or `list <type of the length> <type> <name>`.
fn property(words: &[&str]) -> Option<Property> {
    match words {
        ["list", length, kind, name] => {
            Some(Property { name: (*name).to_owned(), length: Some(Kind::of(length)?), kind: Kind::of(kind)? })
        }
        [kind, name] => Some(Property { name: (*name).to_owned(), length: None, kind: Kind::of(kind)? }),
        _ => None,
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

/// The indices of a face.
fn polygon(reader: &mut Reader, element: &Element) -> Result<Vec<f64>, MeshError> {
    let mut corners = Vec::new();
    entry(reader, element, |property, numbers| {
        if ["vertex_indices", "vertex_index"].contains(&property) {
            corners = numbers.to_vec();
        }
    })?;
    Ok(corners)
}

/// Reads one entry, and hands over the numbers of each of its properties.
fn entry(reader: &mut Reader, element: &Element, mut take: impl FnMut(&str, &[f64])) -> Result<(), MeshError> {
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
    Ok(())
}

/// A place in the file.
struct Reader<'a> {
    file: &'a Path,
    bytes: &'a [u8],
    at: usize,
    /// Number of line ends before that place, as long as the file is text.
    line: usize,
    encoding: Encoding,
}

impl<'a> Reader<'a> {
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
        if self.encoding == Encoding::Text {
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

    fn word(&mut self) -> Result<f64, MeshError> {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            // The header ended with a line end, which counted its own line.
            self.line += usize::from(*byte == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if end == 0 {
            return Err(self.error(Problem::Ends { expected: "a number" }));
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
