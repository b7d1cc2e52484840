//! Wavefront's text file. Source: Wavefront Technologies, Object Files (.obj), Advanced Visualizer manual, appendix B1.

use std::io::{self, Write};

use super::place;
use crate::SurfaceMesh;

pub(super) fn write(out: &mut dyn Write, mesh: &SurfaceMesh) -> io::Result<()> {
    for x in &mesh.vertices {
        writeln!(out, "v {}", place(x))?;
    }
    for element in &mesh.elements {
        let [a, b, c] = element.map(|i| i + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}
