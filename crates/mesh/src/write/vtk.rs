//! VTK's old unstructured grid as text, which every version of VTK reads. Source: VTK file formats, section «Simple legacy formats».

use std::io::{self, Write};

use super::{place, vtu};
use crate::Mesh;

pub(super) fn write<const N: usize>(out: &mut dyn Write, mesh: &Mesh<3, N>) -> io::Result<()> {
    let (points, cells) = (mesh.vertices.len(), mesh.elements.len());
    writeln!(out, "# vtk DataFile Version 3.0\nfem-mesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {points} double")?;
    for x in &mesh.vertices {
        writeln!(out, "{}", place(x))?;
    }
    writeln!(out, "\nCELLS {cells} {}", (N + 1) * cells)?;
    for element in &mesh.elements {
        write!(out, "{N}")?;
        element.iter().try_for_each(|i| write!(out, " {i}"))?;
        writeln!(out)?;
    }
    writeln!(out, "\nCELL_TYPES {cells}")?;
    (0..cells).try_for_each(|_| writeln!(out, "{}", vtu::cell_type::<N>()))
}
