//! VTK's unstructured grids. Source: VTK file formats, section «XML file formats», «UnstructuredGrid».

mod array;

use std::path::Path;

use nalgebra::Vector3;
use roxmltree::{Document, Node};

use self::array::{Arrays, split_appended};
use super::cells::{self, Cells, Field};
use super::content::Content;
use crate::{MeshError, Problem};

/// Reads the tetrahedra and polygons of all pieces. Points and lines are skipped; other volume cells are an error.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Content, MeshError> {
    let (text, appended) = split_appended(file, bytes)?;
    let document = Document::parse(&text).map_err(|error| {
        let problem = Problem::Malformed { reason: format!("this is not well-formed XML ({error})") };
        MeshError::in_line(file, error.pos().row as usize, problem)
    })?;
    let arrays = Arrays::new(file, document.root_element(), appended);
    let grid = arrays.child(document.root_element(), "UnstructuredGrid")?;
    let mut content = Content::default();
    for piece in grid.children().filter(|node| node.has_tag_name("Piece")) {
        let first = content.vertices.len();
        let points = arrays.child(piece, "Points")?;
        content.vertices.extend(read_points(&arrays, points)?);
        let count = content.vertices.len() - first;
        arrays.check_count(piece, "NumberOfPoints", "points", count)?;
        read_cells(&arrays, piece, count, &mut content)?;
    }
    Ok(content)
}

fn read_points(arrays: &Arrays, points: Node) -> Result<Vec<Vector3<f64>>, MeshError> {
    let array = arrays.child(points, "DataArray")?;
    let places = arrays.floats(array)?;
    if !places.len().is_multiple_of(3) || array.attribute("NumberOfComponents").is_some_and(|n| n.trim() != "3") {
        let reason = format!("{} coordinates are not three for each point", places.len());
        return Err(arrays.error(points, Problem::Malformed { reason }));
    }
    match places.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(arrays.error(points, Problem::VertexNotFinite { vertex: i / 3 })),
        None => Ok(places.chunks_exact(3).map(Vector3::from_column_slice).collect()),
    }
}

/// Adds a piece's cells, whose corners are indices of its own points, and its sets.
fn read_cells(arrays: &Arrays, piece: Node, points: usize, content: &mut Content) -> Result<(), MeshError> {
    let cells = arrays.child(piece, "Cells")?;
    let kinds = arrays.integers(arrays.named(cells, "types")?)?;
    let ends = arrays.integers(arrays.named(cells, "offsets")?)?;
    let connectivity = arrays.integers(arrays.named(cells, "connectivity")?)?;
    arrays.check_count(piece, "NumberOfCells", "cells", kinds.len())?;
    let fields = fields(arrays, piece, "CellData", kinds.len(), content)?;
    let found = Cells { ends: &ends, connectivity: &connectivity, kinds: &kinds };
    cells::add_all(content, &found, points, fields).map_err(|problem| arrays.error(cells, problem))?;
    let fields = self::fields(arrays, piece, "PointData", points, content)?;
    cells::add_points(content, points, fields);
    Ok(())
}

/// The fields that may make sets: those of single integers. Others are named as not read.
fn fields(
    arrays: &Arrays,
    piece: Node,
    of: &str,
    count: usize,
    content: &mut Content,
) -> Result<Vec<Field>, MeshError> {
    let mut fields = Vec::new();
    let Some(data) = piece.children().find(|child| child.has_tag_name(of)) else { return Ok(fields) };
    for array in data.children().filter(|child| child.is_element()) {
        let name = array.attribute("Name").unwrap_or("(without a name)");
        let is_scalar = array.attribute("NumberOfComponents").is_none_or(|components| components.trim() == "1");
        let is_integer =
            array.attribute("type").is_some_and(|kind| kind.starts_with("Int") || kind.starts_with("UInt"));
        if name == "vtkGhostType" || !is_scalar || !is_integer {
            content.notes.unread(format!("the field `{name}`"));
            continue;
        }
        let values = arrays.integers(array)?;
        if values.len() != count {
            let problem = Problem::WrongCount { what: "values of a field", announced: count, found: values.len() };
            return Err(arrays.error(array, problem));
        }
        fields.push(Field { name: name.to_owned(), values });
    }
    Ok(fields)
}
