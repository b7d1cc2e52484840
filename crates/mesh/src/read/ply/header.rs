//! The header of a polygon file: encoding, elements and their properties, and the types of numbers.

use super::Reader;
use crate::{MeshError, Problem};

/// A property of the entries of an element: its name, the type of its length if it is a list, and that of its numbers.
pub(super) struct Property {
    pub name: String,
    pub length: Option<Kind>,
    pub kind: Kind,
}

/// A kind of entry, such as `vertex`, with their number.
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

/// The lines from `ply` to `end_header`.
pub(super) fn header(reader: &mut Reader) -> Result<Vec<Element>, MeshError> {
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

/// A number's type in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Kind {
    pub(super) fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "long" | "int64" => Self::I64,
            "ulong" | "uint64" => Self::U64,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The number that begins these bytes, the least significant first.
    pub(super) fn number(self, bytes: [u8; 8]) -> f64 {
        let [a, b, c, d, ..] = bytes;
        match self {
            Self::I8 => f64::from(a as i8),
            Self::U8 => f64::from(a),
            Self::I16 => f64::from(i16::from_le_bytes([a, b])),
            Self::U16 => f64::from(u16::from_le_bytes([a, b])),
            Self::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Self::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            // Indices are exact up to 2⁵³.
            Self::I64 => i64::from_le_bytes(bytes) as f64,
            Self::U64 => u64::from_le_bytes(bytes) as f64,
            Self::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Self::F64 => f64::from_le_bytes(bytes),
        }
    }
}

/// How numbers are written.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}
