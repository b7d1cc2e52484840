//! Gmsh's text file, version 4.1, with one volume entity. Source: Gmsh reference manual, «MSH file format».

use std::io::{self, Write};

use super::place;
use crate::TetrahedralMesh;

pub(super) fn write(out: &mut dyn Write, mesh: &TetrahedralMesh) -> io::Result<()> {
    let (nodes, elements) = (mesh.vertices.len(), mesh.elements.len());
    writeln!(out, "$MeshFormat\n4.1 0 8\n$EndMeshFormat")?;
    writeln!(out, "$Nodes\n1 {nodes} 1 {nodes}\n3 1 0 {nodes}")?;
    for tag in 1..=nodes {
        writeln!(out, "{tag}")?;
    }
    for x in &mesh.vertices {
        writeln!(out, "{}", place(x))?;
    }
    writeln!(out, "$EndNodes\n$Elements\n1 {elements} 1 {elements}\n3 1 4 {elements}")?;
    for (i, element) in mesh.elements.iter().enumerate() {
        let [a, b, c, d] = element.map(|node| node + 1);
        writeln!(out, "{} {a} {b} {c} {d}", i + 1)?;
    }
    writeln!(out, "$EndElements")
}
