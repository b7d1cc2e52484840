//! Wavefront's text file, with named sets as groups. Source: Wavefront Technologies, Object Files (.obj), Advanced Visualizer manual,
//! appendix B1.

use std::io::{self, Write};

use super::place;
use crate::SurfaceMesh;

/// Blanks in the names of sets, which divide names, become underscores.
pub(super) fn write(out: &mut dyn Write, mesh: &SurfaceMesh) -> io::Result<()> {
    for x in &mesh.vertices {
        writeln!(out, "v {}", place(x))?;
    }
    let mut groups = vec![String::new(); if mesh.sets.is_empty() { 0 } else { mesh.elements.len() }];
    for (name, set) in &mesh.sets {
        set.elements
            .iter()
            .for_each(|&element| groups[element] += &format!(" {}", name.replace(char::is_whitespace, "_")));
    }
    for (i, element) in mesh.elements.iter().enumerate() {
        if let Some(names) = groups.get(i).filter(|_| i == 0 || groups[i] != groups[i - 1]) {
            writeln!(out, "g{}", if names.is_empty() { " default" } else { names })?;
        }
        let [a, b, c] = element.map(|i| i + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}
