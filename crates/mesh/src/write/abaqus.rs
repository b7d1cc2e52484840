//! Abaqus's input file: nodes, elements, and named sets as sets of elements, of nodes, and surfaces. Source: Abaqus Keywords
//! Reference Guide.

use std::collections::HashMap;
use std::io::{self, Write};

use super::place;
use crate::Mesh;
use crate::read::ABAQUS_FACES;

/// Numbers in a row of a set.
const IN_ROW: usize = 12;

/// Writes tetrahedra as C3D4 or C3D10 and triangles as CPS3 or CPS6. Of the edges of sets the nodes are written: trusses would need a section.
pub(super) fn write<const N: usize>(out: &mut dyn Write, mesh: &Mesh<3, N>) -> io::Result<()> {
    writeln!(out, "*HEADING\nwritten by fem-mesh\n*NODE")?;
    for (i, x) in mesh.vertices.iter().enumerate() {
        writeln!(out, "{}, {}", i + 1, place(x).replace(' ', ", "))?;
    }
    let kind = match N {
        4 => "C3D4",
        10 => "C3D10",
        6 => "CPS6",
        _ => "CPS3",
    };
    writeln!(out, "*ELEMENT, TYPE={kind}")?;
    for (i, element) in mesh.elements.iter().enumerate() {
        writeln!(out, "{}{}", i + 1, numbers(element))?;
    }
    let sides = sides(mesh);
    for (name, set) in &mesh.sets {
        // A label begins with a letter and has no blanks, or it stands in quotation marks, which CalculiX takes as a part of the name.
        // CalculiX 2.20 crashes where a load names a surface `9`, but not at `"9"`.
        let is_label = name.starts_with(|c: char| c.is_ascii_alphabetic()) && !name.contains([' ', '\t', ',']);
        let name = if is_label { name.clone() } else { format!("\"{name}\"") };
        if !set.elements.is_empty() {
            writeln!(out, "*ELSET, ELSET={name}")?;
            rows(out, &set.elements)?;
        }
        let mut nodes = [&set.points[..], &set.edges.concat()].concat();
        nodes.sort_unstable();
        nodes.dedup();
        if !nodes.is_empty() {
            writeln!(out, "*NSET, NSET={name}")?;
            rows(out, &nodes)?;
        }
        if !set.faces.is_empty() {
            writeln!(out, "*SURFACE, NAME={name}, TYPE=ELEMENT")?;
            for (element, side) in set.faces.iter().filter_map(|face| sides.get(face)) {
                writeln!(out, "{}, S{side}", element + 1)?;
            }
        }
    }
    Ok(())
}

fn numbers(nodes: &[usize]) -> String {
    nodes.iter().map(|node| format!(", {}", node + 1)).collect()
}

fn rows(out: &mut dyn Write, list: &[usize]) -> io::Result<()> {
    list.chunks(IN_ROW).try_for_each(|row| writeln!(out, "{}", &numbers(row)[2..]))
}

/// An element and its side, counted from 1, for each face of the sets.
fn sides<const N: usize>(mesh: &Mesh<3, N>) -> HashMap<[usize; 3], (usize, usize)> {
    let faces = mesh.sets.values().flat_map(|set| &set.faces);
    let mut sides: HashMap<[usize; 3], (usize, usize)> = faces.map(|&face| (face, (0, 0))).collect();
    let is_solid = matches!(N, 4 | 10);
    let elements = if is_solid && !sides.is_empty() { &mesh.elements[..] } else { &[] };
    for (i, element) in elements.iter().enumerate() {
        for (side, face) in ABAQUS_FACES.iter().enumerate() {
            let mut nodes = face.map(|corner| element[corner]);
            nodes.sort_unstable();
            sides.entry(nodes).and_modify(|found| *found = (i, side + 1));
        }
    }
    sides
}
