//! MEDIT's text file, version 2 (double precision), with a reference for each part of a named set. Source: P. Frey, INRIA RT-0253, 2001,
//! appendix.

use std::io::{self, Write};

use super::sets::Tags;
use super::{place, place_in_plane};
use crate::Mesh;

/// Writes tetrahedra or triangles. Triangles in the plane z = 0 become a file of two dimensions.
pub(super) fn write<const N: usize>(out: &mut dyn Write, mesh: &Mesh<3, N>) -> io::Result<()> {
    let is_plane = N == 3 && mesh.vertices.iter().all(|x| x.z.to_bits() == 0);
    let dimension = if is_plane { 2 } else { 3 };
    let tags = Tags::of(mesh);
    writeln!(
        out,
        "MeshVersionFormatted 2\n{}Dimension {dimension}\n\nVertices\n{}",
        tags.comments(),
        mesh.vertices.len()
    )?;
    for (x, tag) in mesh.vertices.iter().zip(&tags.nodes) {
        writeln!(out, "{} {tag}", if is_plane { place_in_plane(x) } else { place(x) })?;
    }
    let elements = mesh.elements.iter().map(|element| &element[..]).zip(tags.elements.iter().copied());
    section(out, if N == 3 { "Triangles" } else { "Tetrahedra" }, mesh.elements.len(), elements)?;
    section(out, "Triangles", tags.faces.len(), tags.faces.iter().map(|(face, tag)| (&face[..], *tag)))?;
    section(out, "Edges", tags.edges.len(), tags.edges.iter().map(|(edge, tag)| (&edge[..], *tag)))?;
    writeln!(out, "\nEnd")
}

/// Nodes, counted from 1, and the tag of each entry. A section of none is left out.
fn section<'a>(
    out: &mut dyn Write,
    keyword: &str,
    count: usize,
    mut entries: impl Iterator<Item = (&'a [usize], i32)>,
) -> io::Result<()> {
    if count == 0 {
        return Ok(());
    }
    writeln!(out, "\n{keyword}\n{count}")?;
    entries.try_for_each(|(nodes, tag)| {
        nodes.iter().try_for_each(|i| write!(out, "{} ", i + 1))?;
        writeln!(out, "{tag}")
    })
}
