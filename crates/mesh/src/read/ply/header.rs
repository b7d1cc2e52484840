//! The header of a polygon file: encoding, elements and their properties.

use super::number::{Encoding, Kind};
use super::reader::Reader;
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
