//! VTK's old unstructured grids and polygons, text and binary. Source: VTK file formats, section «Simple legacy formats».

mod reader;

use std::path::Path;

use nalgebra::Vector3;

use self::reader::Reader;
use super::cells;
use super::content::Content;
use crate::{MeshError, Problem};

const GRID: &str = "save it as an unstructured grid (ParaView: .vtu)";

/// VTK's number for a polygon.
const POLYGON: i64 = 7;

/// Reads tetrahedra and polygons, in the layout before version 5 and since. Points and lines are skipped; other volume cells are an error.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Content, MeshError> {
    let mut reader = Reader::new(file, bytes);
    read_header(&mut reader)?;
    let mut content = Content::default();
    let (mut cells, mut kinds) = (Cells::default(), Vec::new());
    while let Some(keyword) = reader.word() {
        match &keyword.to_ascii_uppercase()[..] {
            "POINTS" => content.vertices = read_points(&mut reader)?,
            "CELLS" => cells = read_cells(&mut reader)?,
            "POLYGONS" => {
                cells = read_cells(&mut reader)?;
                kinds = vec![POLYGON; cells.count()];
            }
            "VERTICES" | "LINES" => drop(read_cells(&mut reader)?),
            "TRIANGLE_STRIPS" => {
                read_cells(&mut reader)?;
                content.skipped = Some("a surface of strips of triangles".to_owned());
            }
            "CELL_TYPES" => {
                let count = reader.count("the number of cell types")?;
                kinds = reader.integers(count, "int")?;
            }
            "METADATA" => reader.skip_paragraph(),
            "FIELD" => skip_field(&mut reader)?,
            // Data of points and cells end the grid.
            "POINT_DATA" | "CELL_DATA" => break,
            _ => {
                return Err(
                    reader.malformed(format!("`{keyword}` is no keyword of an unstructured grid or of polygons"))
                );
            }
        }
    }
    add_cells(&mut content, &cells, &kinds).map_err(|problem| MeshError::in_file(file, problem))?;
    Ok(content)
}

/// A line of version, a line of title, `ASCII` or `BINARY`, and the kind of data set.
fn read_header(reader: &mut Reader) -> Result<(), MeshError> {
    let unsupported = |reader: &Reader, found: String| reader.error(Problem::Unsupported { found, instead: GRID });
    if !reader.line().starts_with("# vtk DataFile Version") {
        return Err(unsupported(reader, "a .vtk file that does not begin with `# vtk DataFile Version`".to_owned()));
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
    /// Ends of the cells in the connectivity, beginning with 0.
    offsets: Vec<i64>,
    connectivity: Vec<i64>,
}

impl Cells {
    fn count(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }
}

/// Before version 5: `<cells> <numbers>`, then the number of points and the points of each cell. Since then: `<offsets>
/// <numbers>`, and the two arrays `OFFSETS` and `CONNECTIVITY`, each with its type.
fn read_cells(reader: &mut Reader) -> Result<Cells, MeshError> {
    let (count, size) = (reader.count("the number of cells")?, reader.count("the number of numbers")?);
    let mut ahead = reader.clone();
    if ahead.word().is_some_and(|word| word.eq_ignore_ascii_case("OFFSETS")) {
        *reader = ahead;
        let kind = reader.expected("the type of the offsets")?;
        let offsets = reader.integers(count, &kind)?;
        let keyword = reader.expected("the keyword CONNECTIVITY")?;
        if !keyword.eq_ignore_ascii_case("CONNECTIVITY") {
            return Err(reader.error(Problem::NotA { word: keyword, expected: "the keyword CONNECTIVITY" }));
        }
        let kind = reader.expected("the type of the connectivity")?;
        return Ok(Cells { offsets, connectivity: reader.integers(size, &kind)? });
    }
    let mut connectivity = reader.integers(size, "int")?;
    let mut offsets = Vec::with_capacity(1 + count.min(connectivity.len() / 2));
    offsets.push(0);
    let (mut at, mut end) = (0, 0);
    while let Some(&points) = connectivity.get(at) {
        let left = connectivity.len() - at - 1;
        let Some(points) = usize::try_from(points).ok().filter(|&points| points <= left) else {
            let reason = format!("cell {} announces {points} points and {left} numbers are left", offsets.len() - 1);
            return Err(reader.malformed(reason));
        };
        // The points of the cells move together over the counts.
        connectivity.copy_within(at + 1..at + 1 + points, end);
        (at, end) = (at + 1 + points, end + points);
        offsets.push(end as i64);
    }
    connectivity.truncate(end);
    match offsets.len() - 1 {
        found if found == count => Ok(Cells { offsets, connectivity }),
        found => Err(reader.error(Problem::WrongCount { what: "cells", announced: count, found })),
    }
}

fn add_cells(content: &mut Content, cells: &Cells, kinds: &[i64]) -> Result<(), Problem> {
    let (found, points) = (cells.count(), content.vertices.len());
    if kinds.len() != found {
        return Err(Problem::WrongCount { what: "cells", announced: kinds.len(), found });
    }
    content.tetrahedra.reserve_exact(cells::tetrahedra(kinds));
    for (cell, (ends, &kind)) in cells.offsets.windows(2).zip(kinds).enumerate() {
        let range = usize::try_from(ends[0]).ok().zip(usize::try_from(ends[1]).ok());
        let corners = range.and_then(|(start, end)| cells.connectivity.get(start..end)).ok_or_else(|| {
            let (start, end, all) = (ends[0], ends[1], cells.connectivity.len());
            Problem::Malformed { reason: format!("cell {cell} is {start} to {end} of a connectivity of {all}") }
        })?;
        cells::add(content, cell, kind, corners, points)?;
    }
    Ok(())
}

/// `<name> <arrays>`, then `<name> <components> <tuples> <type>` and the numbers of each array.
fn skip_field(reader: &mut Reader) -> Result<(), MeshError> {
    reader.expected("the name of a field")?;
    for _ in 0..reader.count("the number of arrays of a field")? {
        reader.expected("the name of an array")?;
        let components = reader.count("the number of components")?;
        let tuples = reader.count("the number of tuples")?;
        let kind = reader.expected("the type of an array")?;
        reader.skip_array(components.saturating_mul(tuples), &kind)?;
    }
    Ok(())
}
