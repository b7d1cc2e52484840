//! VTK's old unstructured grid as text, which every version of VTK reads, with a field of zeros and ones for each named set. Source: VTK file
//! formats, section «Simple legacy formats».

use std::io::{self, Write};

use super::sets::Marks;
use super::{place, vtu};
use crate::Mesh;

pub(super) fn write<const N: usize>(out: &mut dyn Write, mesh: &Mesh<3, N>) -> io::Result<()> {
    let (points, marks) = (mesh.vertices.len(), Marks::of(mesh));
    let cells = mesh.elements.len() + marks.cells.len();
    let numbers = (N + 1) * mesh.elements.len() + marks.cells.iter().map(|cell| cell.len() + 1).sum::<usize>();
    writeln!(
        out,
        "# vtk DataFile Version 3.0\nwritten by fem-mesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {points} double"
    )?;
    for x in &mesh.vertices {
        writeln!(out, "{}", place(x))?;
    }
    writeln!(out, "\nCELLS {cells} {numbers}")?;
    for cell in mesh.elements.iter().map(|element| &element[..]).chain(marks.cells.iter().map(|cell| &cell[..])) {
        write!(out, "{}", cell.len())?;
        cell.iter().try_for_each(|i| write!(out, " {i}"))?;
        writeln!(out)?;
    }
    writeln!(out, "\nCELL_TYPES {cells}")?;
    (0..mesh.elements.len()).try_for_each(|_| writeln!(out, "{}", vtu::cell_type(N)))?;
    marks.cells.iter().try_for_each(|cell| writeln!(out, "{}", vtu::cell_type(cell.len())))?;
    fields(out, "CELL_DATA", cells, &marks.of_cells)?;
    fields(out, "POINT_DATA", points, &marks.of_nodes)
}

fn fields(out: &mut dyn Write, keyword: &str, count: usize, fields: &[(String, Vec<u8>)]) -> io::Result<()> {
    if fields.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{keyword} {count}\nFIELD sets {}", fields.len())?;
    for (name, values) in fields {
        writeln!(out, "{} 1 {count} unsigned_char", escaped(name))?;
        values.iter().try_for_each(|value| writeln!(out, "{value}"))?;
    }
    Ok(())
}

/// A name in one word, as VTK writes it.
fn escaped(name: &str) -> String {
    let byte = |byte: u8| match byte {
        b'%' | b'"' | 0..=b' ' | 127.. => format!("%{byte:02X}"),
        _ => char::from(byte).to_string(),
    };
    name.bytes().map(byte).collect()
}
