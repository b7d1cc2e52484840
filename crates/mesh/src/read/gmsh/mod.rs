//! Gmsh's files: version 1 and 4.0 as text, versions 2.0 to 2.2 and 4.1 as text and binary. Source: Gmsh reference manual, section «MSH file
//! format» and its appendix.

mod builder;
mod kinds;
mod numbers;
mod version2;
mod version4;

use std::path::Path;

use self::builder::Builder;
use self::numbers::Numbers;
use self::version4::{Entities, Layout};
use super::content::Content;
use super::readable;
use super::words::Words;
use crate::{MeshError, Problem};

const CONVERT: &str = "convert it with `gmsh IN.msh -0 -format msh41 -setnumber Mesh.Binary 0 -o OUT.msh`";

#[derive(Clone, Copy, PartialEq)]
enum Version {
    V1,
    V2,
    V4(Layout),
}

/// The content of `$MeshFormat`.
struct Format {
    version: Version,
    is_binary: bool,
    /// The byte after its line.
    end: usize,
}

/// Reads the tetrahedra and triangles of all entities, and the physical groups as named sets. Other volume elements are an error.
pub(super) fn read(file: &Path, bytes: Vec<u8>) -> Result<Content, MeshError> {
    let Format { version, is_binary, end } = read_format(file, &bytes)?;
    if !is_binary {
        // Names and comments may be in any encoding.
        let text = readable(bytes);
        return read_sections(&mut Numbers::of_text(file, text.trim_start_matches('\u{feff}')), version);
    }
    let mut numbers = Numbers::of_bytes(file, &bytes, end);
    check_byte_order(&mut numbers)?;
    read_sections(&mut numbers, version)
}

fn read_sections(numbers: &mut Numbers, version: Version) -> Result<Content, MeshError> {
    let (mut mesh, mut entities) = (Builder::default(), Entities::new());
    while let Some(section) = numbers.section()? {
        match (&section[..], version) {
            ("PhysicalNames", _) => read_names(numbers, &mut mesh)?,
            ("Entities", Version::V4(layout)) => version4::read_entities(numbers, layout, &mut entities)?,
            ("PartitionedEntities", Version::V4(layout)) => version4::read_partitioned(numbers, layout, &mut entities)?,
            ("Nodes", Version::V4(layout)) => version4::read_nodes(numbers, layout, &mut mesh)?,
            ("Elements", Version::V4(layout)) => version4::read_elements(numbers, layout, &entities, &mut mesh)?,
            ("Nodes", Version::V2) | ("NOD", Version::V1) => version2::read_nodes(numbers, &section, &mut mesh)?,
            ("Elements", Version::V2) | ("ELM", Version::V1) => {
                version2::read_elements(numbers, version == Version::V1, &mut mesh)?
            }
            (other, _) => {
                numbers.skip(other)?;
                if !["MeshFormat", "Comments"].contains(&other) {
                    mesh.content.notes.unread(format!("the section ${other}"));
                }
            }
        }
    }
    Ok(mesh.finish())
}

/// A count, then `<dimension> <number> "<name>"` for each physical group.
fn read_names(numbers: &mut Numbers, mesh: &mut Builder) -> Result<(), MeshError> {
    let announced = numbers.text_count("the number of names")?;
    for _ in 0..announced {
        let line = numbers.text_line("the name of a physical group")?;
        let mut words = line.trim().splitn(3, char::is_whitespace);
        let dimension = words.next().and_then(|word| word.parse().ok());
        let number = words.next().and_then(|word| word.parse().ok());
        let name = words.next().map(|name| name.trim().trim_matches('"'));
        let (Some(dimension), Some(number), Some(name)) = (dimension, number, name) else {
            let expected = "a dimension, a number and the name of a physical group";
            return Err(numbers.error(Problem::NotA { word: line.trim().to_owned(), expected }));
        };
        mesh.name((dimension, number), name);
    }
    numbers.end("PhysicalNames", "names of physical groups", announced, announced)
}

fn read_format(file: &Path, bytes: &[u8]) -> Result<Format, MeshError> {
    let unsupported = |found: String| Problem::Unsupported { found, instead: CONVERT };
    let mut end = 0;
    let mut lines = bytes.split_inclusive(|&byte| byte == b'\n').enumerate().map(|(number, line)| {
        end += line.len();
        (number + 1, end, String::from_utf8_lossy(line))
    });
    let missing = || MeshError::in_file(file, unsupported("a file without the section $MeshFormat".to_owned()));
    let is_first = |line: &str| ["$MeshFormat", "$NOD"].contains(&line.trim_start_matches('\u{feff}').trim());
    let (_, _, first) = lines.find(|(_, _, line)| is_first(line)).ok_or_else(missing)?;
    if first.trim() == "$NOD" {
        return Ok(Format { version: Version::V1, is_binary: false, end: 0 });
    }
    let expected = "the version";
    let ends = || MeshError::in_file(file, Problem::Ends { expected });
    let (number, end, line) = lines.find(|(_, _, line)| !line.trim().is_empty()).ok_or_else(ends)?;
    let mut line = Words::of_line(file, number, &line);
    let version = match line.word(expected)? {
        "4.1" => Version::V4(Layout::V41),
        "4" | "4.0" => Version::V4(Layout::V40),
        "2" | "2.0" | "2.1" | "2.2" => Version::V2,
        other => return Err(line.error(unsupported(format!("Gmsh format {other}")))),
    };
    let is_binary = line.amount("the kind of file, 0 for text or 1 for binary")? != 0;
    if is_binary && version == Version::V4(Layout::V40) {
        return Err(line.error(unsupported("a binary file of Gmsh format 4.0".to_owned())));
    }
    let size = line.amount("the size of a number in bytes")?;
    if is_binary && size != 8 {
        return Err(line.error(unsupported(format!("a binary Gmsh file with numbers of {size} bytes"))));
    }
    Ok(Format { version, is_binary, end })
}

/// A binary file begins with the integer 1.
fn check_byte_order(numbers: &mut Numbers) -> Result<(), MeshError> {
    match numbers.int("the integer 1 that tells the byte order")? {
        1 => numbers.end("MeshFormat", "", 0, 0),
        0x0100_0000 => {
            let found = "a big-endian binary file".to_owned();
            Err(numbers.error(Problem::Unsupported { found, instead: CONVERT }))
        }
        other => {
            let expected = "the integer 1 that tells the byte order";
            Err(numbers.error(Problem::NotA { word: other.to_string(), expected }))
        }
    }
}
