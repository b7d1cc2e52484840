//! VTK's unstructured grid with fields, as XML with base64 arrays. Source: VTK file formats, «XML file formats».

use std::io::{self, Write};
use std::path::Path;

use base64::prelude::{BASE64_STANDARD, Engine};
use nalgebra::Vector3;

use super::sets::Marks;
use super::{escape, save_mesh};
use crate::{Mesh, MeshError, Problem};

/// VTK's number for the line with 2 nodes, the triangle with 3 or 6 and the tetrahedron with 4 or 10.
pub(super) const fn cell_type(nodes: usize) -> u8 {
    match nodes {
        2 => 3,
        3 => 5,
        6 => 22,
        10 => 24,
        _ => 10,
    }
}

/// Cells of one kind, to be written.
#[derive(Clone, Copy, Debug)]
pub struct Grid<'a> {
    /// Positions of the nodes, m.
    pub vertices: &'a [Vector3<f64>],
    /// The nodes of the first cell, then those of the next, in VTK's order.
    pub nodes: &'a [usize],
    /// Number of nodes of a cell.
    pub nodes_per_cell: usize,
    /// VTK's number for the kind of cell.
    pub cell_type: u8,
}

impl<'a, const N: usize> From<&'a Mesh<3, N>> for Grid<'a> {
    fn from(mesh: &'a Mesh<3, N>) -> Self {
        let nodes = mesh.elements.as_flattened();
        Self { vertices: &mesh.vertices, nodes, nodes_per_cell: N, cell_type: cell_type(N) }
    }
}

/// Values at the points or in the cells of a mesh, such as `displacement` in m with 3 components.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// Name in ParaView, with the unit.
    pub name: &'a str,
    /// Number of values of each point or cell: 1 for a scalar, 3 for a vector, 9 for a matrix row by row.
    pub components: usize,
    /// `(components · points)` or `(components · cells)` values, those of one point or cell contiguous.
    pub values: &'a [f64],
}

/// Writes cells with fields at the points (displacement, velocity) and in the cells (von Mises stress), for ParaView.
///
/// Points keep the positions of `grid`; ParaView's filter «Warp By Vector» moves them by a displacement.
pub fn write_vtu<'a>(
    path: &Path,
    grid: impl Into<Grid<'a>>,
    point_fields: &[Field],
    cell_fields: &[Field],
) -> Result<(), MeshError> {
    let grid = grid.into();
    let cells = grid.nodes.len() / grid.nodes_per_cell;
    check_sizes(point_fields, grid.vertices.len(), "point").map_err(|problem| MeshError::in_file(path, problem))?;
    check_sizes(cell_fields, cells, "cell").map_err(|problem| MeshError::in_file(path, problem))?;
    let marks = Marks { cells: Vec::new(), of_cells: Vec::new(), of_nodes: Vec::new() };
    save_mesh(path, &mut |out| write_grid(out, grid, &marks, point_fields, cell_fields))
}

/// Writes a mesh with a field of zeros and ones for each named set; faces and edges of sets are cells behind the elements.
pub(super) fn write_with_sets<const N: usize>(path: &Path, mesh: &Mesh<3, N>) -> Result<(), MeshError> {
    let marks = Marks::of(mesh);
    save_mesh(path, &mut |out| write_grid(out, mesh.into(), &marks, &[], &[]))
}

fn check_sizes(fields: &[Field], entries: usize, per: &'static str) -> Result<(), Problem> {
    for Field { name, components, values } in fields {
        let expected = components.saturating_mul(entries);
        if values.len() != expected {
            let (name, found) = ((*name).to_owned(), values.len());
            return Err(Problem::FieldSize { name, found, expected, components: *components, per });
        }
    }
    Ok(())
}

fn write_grid(
    out: &mut dyn Write,
    grid: Grid,
    marks: &Marks,
    point_fields: &[Field],
    cell_fields: &[Field],
) -> io::Result<()> {
    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(out, r#"<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#)?;
    let (points, elements) = (grid.vertices.len(), grid.nodes.len() / grid.nodes_per_cell);
    let cells = elements + marks.cells.len();
    writeln!(out, "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">")?;

    writeln!(out, "<Points>")?;
    array(out, "Points", "Float64", 3, grid.vertices.iter().flatten().flat_map(|x| x.to_le_bytes()))?;
    writeln!(out, "</Points>\n<Cells>")?;
    let nodes = grid.nodes.iter().chain(marks.cells.iter().flatten());
    array(out, "connectivity", "Int64", 1, nodes.flat_map(|&i| (i as i64).to_le_bytes()))?;
    let sizes = std::iter::repeat_n(grid.nodes_per_cell, elements).chain(marks.cells.iter().map(Vec::len));
    let ends = sizes.clone().scan(0, |end, size| {
        *end += size as i64;
        Some(*end)
    });
    array(out, "offsets", "Int64", 1, ends.flat_map(i64::to_le_bytes))?;
    let types =
        std::iter::repeat_n(grid.cell_type, elements).chain(marks.cells.iter().map(|cell| cell_type(cell.len())));
    array(out, "types", "UInt8", 1, types)?;
    writeln!(out, "</Cells>\n<PointData>")?;
    write_fields(out, point_fields)?;
    write_marks(out, &marks.of_nodes)?;
    writeln!(out, "</PointData>\n<CellData>")?;
    write_fields(out, cell_fields)?;
    write_marks(out, &marks.of_cells)?;
    writeln!(out, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

fn write_fields(out: &mut dyn Write, fields: &[Field]) -> io::Result<()> {
    for field in fields {
        array(out, field.name, "Float64", field.components, field.values.iter().flat_map(|x| x.to_le_bytes()))?;
    }
    Ok(())
}

fn write_marks(out: &mut dyn Write, fields: &[(String, Vec<u8>)]) -> io::Result<()> {
    fields.iter().try_for_each(|(name, values)| array(out, name, "UInt8", 1, values.iter().copied()))
}

/// Writes an array as base64 of the number of bytes followed by the bytes.
fn array(
    out: &mut dyn Write,
    name: &str,
    kind: &str,
    components: usize,
    values: impl Iterator<Item = u8>,
) -> io::Result<()> {
    let mut bytes = vec![0; 8];
    bytes.extend(values);
    let length = (bytes.len() - 8) as u64;
    bytes[..8].copy_from_slice(&length.to_le_bytes());
    let name = escape(name);
    writeln!(
        out,
        r#"<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="binary">{}</DataArray>"#,
        BASE64_STANDARD.encode(&bytes)
    )
}
