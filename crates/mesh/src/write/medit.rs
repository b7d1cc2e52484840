//! MEDIT's text file, version 2 (double precision). Source: P. Frey, INRIA RT-0253, 2001, appendix.

use std::io::{self, Write};

use super::{place, place_in_plane};
use crate::Mesh;

/// Writes tetrahedra or triangles. Triangles in the plane z = 0 become a file of two dimensions.
pub(super) fn write<const N: usize>(out: &mut dyn Write, mesh: &Mesh<3, N>) -> io::Result<()> {
    let is_plane = N == 3 && mesh.vertices.iter().all(|x| x.z.to_bits() == 0);
    let dimension = if is_plane { 2 } else { 3 };
    writeln!(out, "MeshVersionFormatted 2\nDimension {dimension}\n\nVertices\n{}", mesh.vertices.len())?;
    for x in &mesh.vertices {
        writeln!(out, "{} 0", if is_plane { place_in_plane(x) } else { place(x) })?;
    }
    writeln!(out, "\n{}\n{}", if N == 3 { "Triangles" } else { "Tetrahedra" }, mesh.elements.len())?;
    for element in &mesh.elements {
        element.iter().try_for_each(|i| write!(out, "{} ", i + 1))?;
        writeln!(out, "0")?;
    }
    writeln!(out, "\nEnd")
}
