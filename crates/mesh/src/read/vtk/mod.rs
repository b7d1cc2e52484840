//! VTK's old unstructured grids and polygons, text and binary. Source: VTK file formats, section «Simple legacy formats».

mod reader;

use std::path::Path;

use nalgebra::Vector3;

use self::reader::{Reader, is_integer};
use super::cells::{self, Field};
use super::content::Content;
use crate::{MeshError, Problem};

/// VTK's number for a line of several points, which makes no part of a mesh.
const POLY_LINE: i64 = 4;

const GRID: &str = "save it as an unstructured grid (ParaView: .vtu)";

/// Reads tetrahedra and polygons, in the layout before version 5 and since, and sets from fields of integers. Other volume cells are an
/// error.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Content, MeshError> {
    let mut reader = Reader::new(file, bytes);
    read_header(&mut reader)?;
    let mut content = Content::default();
    let (mut cells, mut kinds) = (Cells::default(), Vec::new());
    let (mut of_cells, mut of_points) = (Vec::new(), Vec::new());
    while let Some(keyword) = reader.word() {
        match &keyword.to_ascii_uppercase()[..] {
            "POINTS" => content.vertices = read_points(&mut reader)?,
            "CELLS" => cells = read_cells(&mut reader)?,
            // Polygonal data may have each of these.
            "VERTICES" | "LINES" => cells.extend(read_cells(&mut reader)?, POLY_LINE, &mut kinds),
            "POLYGONS" => cells.extend(read_cells(&mut reader)?, cells::POLYGON, &mut kinds),
            "TRIANGLE_STRIPS" => cells.extend(read_cells(&mut reader)?, cells::STRIP, &mut kinds),
            "CELL_TYPES" => {
                let count = reader.count("the number of cell types")?;
                kinds = reader.integers(count, "int")?;
            }
            "METADATA" => reader.skip_paragraph(),
            "FIELD" => read_field(&mut reader, &mut content, None)?,
            "POINT_DATA" | "CELL_DATA" => {
                let count = reader.count("the number of points or cells")?;
                let is_cells = keyword.eq_ignore_ascii_case("CELL_DATA");
                let what = if is_cells { "values of cells" } else { "values of points" };
                let expected = if is_cells { cells.ends.len() } else { content.vertices.len() };
                if count != expected {
                    return Err(reader.error(Problem::WrongCount { what, announced: count, found: expected }));
                }
                let fields = if is_cells { &mut of_cells } else { &mut of_points };
                read_attributes(&mut reader, &mut content, count, fields)?;
            }
            _ => {
                return Err(
                    reader.malformed(format!("`{keyword}` is no keyword of an unstructured grid or of polygons"))
                );
            }
        }
    }
    let found = cells::Cells { ends: &cells.ends, connectivity: &cells.connectivity, kinds: &kinds };
    let points = content.vertices.len();
    cells::add_all(&mut content, &found, points, of_cells).map_err(|problem| MeshError::in_file(file, problem))?;
    cells::add_points(&mut content, points, of_points);
    Ok(content)
}

/// A line of version, a line of title, `ASCII` or `BINARY`, and the kind of data set.
fn read_header(reader: &mut Reader) -> Result<(), MeshError> {
    let unsupported = |reader: &Reader, found: String| reader.error(Problem::Unsupported { found, instead: GRID });
    let start = reader.clone();
    if !reader.line().starts_with("# vtk DataFile Version") {
        return Err(unsupported(&start, "a .vtk file that does not begin with `# vtk DataFile Version`".to_owned()));
    }
    reader.line();
    let encoding = reader.expected("ASCII or BINARY")?;
    reader.is_binary = match &encoding.to_ascii_uppercase()[..] {
        "ASCII" => false,
        "BINARY" => true,
        _ => return Err(reader.error(Problem::NotA { word: encoding, expected: "ASCII or BINARY" })),
    };
    let (keyword, kind) = (reader.expected("the keyword DATASET")?, reader.expected("the kind of data set")?);
    let is_known = ["UNSTRUCTURED_GRID", "POLYDATA"].iter().any(|known| kind.eq_ignore_ascii_case(known));
    if !keyword.eq_ignore_ascii_case("DATASET") || !is_known {
        return Err(unsupported(reader, format!("the data set `{keyword} {kind}`")));
    }
    Ok(())
}

/// `<points> <type>`, then three coordinates of each.
fn read_points(reader: &mut Reader) -> Result<Vec<Vector3<f64>>, MeshError> {
    let count = reader.count("the number of points")?;
    let kind = reader.expected("the type of the points")?;
    let start = reader.clone();
    let places = reader.reals(count.saturating_mul(3), &kind)?;
    match places.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(start.error(Problem::VertexNotFinite { vertex: i / 3 })),
        None => Ok(places.chunks_exact(3).map(Vector3::from_column_slice).collect()),
    }
}

/// The corners of cells.
#[derive(Default)]
struct Cells {
    /// End of each cell in the connectivity.
    ends: Vec<i64>,
    connectivity: Vec<i64>,
}

impl Cells {
    /// Adds cells of one type.
    fn extend(&mut self, more: Self, kind: i64, kinds: &mut Vec<i64>) {
        let start = self.connectivity.len() as i64;
        kinds.extend(std::iter::repeat_n(kind, more.ends.len()));
        self.ends.extend(more.ends.into_iter().map(|end| start.saturating_add(end)));
        self.connectivity.extend(more.connectivity);
    }
}

/// Before version 5: `<cells> <numbers>`, then the number of points and the points of each cell. Since then: `<offsets>
/// <numbers>`, and the two arrays `OFFSETS` and `CONNECTIVITY`, each with its type.
fn read_cells(reader: &mut Reader) -> Result<Cells, MeshError> {
    let (count, size) = (reader.count("the number of cells")?, reader.count("the number of numbers")?);
    if reader.takes("OFFSETS") {
        let kind = reader.expected("the type of the offsets")?;
        let mut ends = reader.integers(count, &kind)?;
        if ends.first().is_some_and(|first| *first != 0) {
            return Err(reader.malformed(format!("the first offset is {}, not 0", ends[0])));
        }
        ends.drain(..count.min(1));
        let keyword = reader.expected("the keyword CONNECTIVITY")?;
        if !keyword.eq_ignore_ascii_case("CONNECTIVITY") {
            return Err(reader.error(Problem::NotA { word: keyword, expected: "the keyword CONNECTIVITY" }));
        }
        let kind = reader.expected("the type of the connectivity")?;
        return Ok(Cells { ends, connectivity: reader.integers(size, &kind)? });
    }
    let mut connectivity = reader.integers(size, "int")?;
    let mut ends = Vec::with_capacity(count.min(connectivity.len() / 2));
    let (mut at, mut end) = (0, 0);
    while let Some(&points) = connectivity.get(at) {
        let left = connectivity.len() - at - 1;
        let Some(points) = usize::try_from(points).ok().filter(|&points| points <= left) else {
            let reason = format!("cell {} announces {points} points and {left} numbers are left", ends.len());
            return Err(reader.malformed(reason));
        };
        // The points of the cells move together over the counts.
        connectivity.copy_within(at + 1..at + 1 + points, end);
        (at, end) = (at + 1 + points, end + points);
        ends.push(end as i64);
    }
    connectivity.truncate(end);
    match ends.len() {
        found if found == count => Ok(Cells { ends, connectivity }),
        found => Err(reader.error(Problem::WrongCount { what: "cells", announced: count, found })),
    }
}

/// Fields of integers if they are asked for. Others are skipped by name.
type Fields<'f> = Option<&'f mut Vec<Field>>;

/// Attributes up to the next keyword that is none: `SCALARS <name> <type> <components>` with its table of colours, vectors, normals and so
/// on, each with its numbers.
fn read_attributes(
    reader: &mut Reader,
    content: &mut Content,
    count: usize,
    fields: &mut Vec<Field>,
) -> Result<(), MeshError> {
    loop {
        if reader.takes("FIELD") {
            read_field(reader, content, Some((count, &mut *fields)))?;
            continue;
        }
        if reader.takes("METADATA") {
            reader.skip_paragraph();
            continue;
        }
        let mut ahead = reader.clone();
        let Some(keyword) = ahead.word() else { return Ok(()) };
        let keyword = keyword.to_ascii_uppercase();
        let components = match &keyword[..] {
            "SCALARS" | "TEXTURE_COORDINATES" | "COLOR_SCALARS" | "LOOKUP_TABLE" | "GLOBAL_IDS" | "PEDIGREE_IDS" => 1,
            "VECTORS" | "NORMALS" => 3,
            "TENSORS" => 9,
            "TENSORS6" => 6,
            _ => return Ok(()),
        };
        *reader = ahead;
        let name = reader.expected("the name of an attribute")?;
        match &keyword[..] {
            "SCALARS" => {
                let kind = reader.expected("the type of an attribute")?;
                let components = match reader.clone().line().trim() {
                    "" => 1,
                    _ => reader.count("the number of components")?,
                };
                if reader.takes("LOOKUP_TABLE") {
                    reader.expected("the name of the table")?;
                }
                keep_or_skip(reader, content, [components, count], &kind, name, Some(&mut *fields))?;
            }
            "LOOKUP_TABLE" => {
                let entries = reader.count("the number of colours")?;
                let kind = if reader.is_binary { "unsigned_char" } else { "float" };
                reader.skip_array(entries.saturating_mul(4), kind)?;
            }
            "COLOR_SCALARS" => {
                let components = reader.count("the number of components")?;
                let kind = if reader.is_binary { "unsigned_char" } else { "float" };
                content.notes.unread(format!("the field `{name}`"));
                reader.skip_array(count.saturating_mul(components), kind)?;
            }
            _ => {
                let mut components = components;
                if keyword == "TEXTURE_COORDINATES" {
                    components = reader.count("the number of components")?;
                }
                let kind = reader.expected("the type of an attribute")?;
                keep_or_skip(reader, content, [components, count], &kind, name, None)?;
            }
        }
    }
}

/// `<name> <arrays>`, then `<name> <components> <tuples> <type>` and the numbers of each array.
fn read_field(
    reader: &mut Reader,
    content: &mut Content,
    mut fields: Option<(usize, &mut Vec<Field>)>,
) -> Result<(), MeshError> {
    reader.expected("the name of a field")?;
    for _ in 0..reader.count("the number of arrays of a field")? {
        let mut name = reader.expected("the name of an array")?;
        if name.eq_ignore_ascii_case("METADATA") {
            reader.skip_paragraph();
            name = reader.expected("the name of an array")?;
        }
        let components = reader.count("the number of components")?;
        let tuples = reader.count("the number of tuples")?;
        let kind = reader.expected("the type of an array")?;
        let fields = fields.as_mut().filter(|(count, _)| *count == tuples).map(|(_, fields)| &mut **fields);
        keep_or_skip(reader, content, [components, tuples], &kind, name, fields)?;
    }
    Ok(())
}

fn keep_or_skip(
    reader: &mut Reader,
    content: &mut Content,
    [components, tuples]: [usize; 2],
    kind: &str,
    name: String,
    fields: Fields,
) -> Result<(), MeshError> {
    let name = unescaped(&name);
    match fields {
        Some(fields) if components == 1 && is_integer(kind) => {
            let values = reader.integers(tuples, kind)?;
            fields.push(Field { name, values });
            Ok(())
        }
        _ => {
            content.notes.unread(format!("the field `{name}`"));
            reader.skip_array(components.saturating_mul(tuples), kind)
        }
    }
}

/// A name in which VTK wrote blanks and other signs as `%20`.
fn unescaped(name: &str) -> String {
    let mut parts = name.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        match part.get(..2).and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => bytes.extend([&[byte], &part.as_bytes()[2..]].concat()),
            None => bytes.extend([b"%", part.as_bytes()].concat()),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
