//! MEDIT's text file, version 2 (double precision). Source: P. Frey, INRIA RT-0253, 2001, appendix.

use std::io::{self, Write};

use super::place;
use crate::TetrahedralMesh;

pub(super) fn write(out: &mut dyn Write, mesh: &TetrahedralMesh) -> io::Result<()> {
    writeln!(out, "MeshVersionFormatted 2\nDimension 3\n\nVertices\n{}", mesh.vertices.len())?;
    for x in &mesh.vertices {
        writeln!(out, "{} 0", place(x))?;
    }
    writeln!(out, "\nTetrahedra\n{}", mesh.elements.len())?;
    for element in &mesh.elements {
        let [a, b, c, d] = element.map(|i| i + 1);
        writeln!(out, "{a} {b} {c} {d} 0")?;
    }
    writeln!(out, "\nEnd")
}
