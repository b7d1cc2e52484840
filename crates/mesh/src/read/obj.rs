//! Wavefront's text files. Source: Wavefront Technologies, Object Files (.obj), Advanced Visualizer manual, appendix B1.

use std::path::Path;

use nalgebra::Vector3;

use super::words::{Words, from_zero};
use crate::{MeshError, Problem, SurfaceMesh};

/// The line of a triangle and its vertex indices.
type Face = (usize, [i64; 3]);

/// Reads `v` and `f`; textures, normals, groups and materials do not change the shape.
///
/// A polygon becomes a fan around its first vertex. A triangle that names a vertex twice has no area and is left out.
pub(super) fn read(file: &Path, text: &str) -> Result<SurfaceMesh, MeshError> {
    let mut vertices: Vec<Vector3<f64>> = Vec::new();
    let mut faces: Vec<Face> = Vec::new();
    for mut line in Words::of_lines(file, text) {
        match line.next() {
            Some("v") => vertices.push(line.place()?),
            Some("f") => polygon(&mut line, vertices.len(), &mut faces)?,
            _ => {}
        }
    }
    if faces.is_empty() {
        return Err(MeshError::in_file(file, Problem::Empty { what: "faces" }));
    }
    // Indices are checked at the end: a face may stand before its vertices.
    let mut elements = Vec::with_capacity(faces.len());
    for (line, corners) in faces {
        let in_line = |problem| MeshError::in_line(file, line, problem);
        let [a, b, c] = corners.map(|index| from_zero(index, 1, vertices.len()).map_err(in_line));
        let (a, b, c) = (a?, b?, c?);
        if a != b && b != c && c != a {
            elements.push([a, b, c]);
        }
    }
    Ok(SurfaceMesh::new(vertices, elements))
}

fn polygon(line: &mut Words, vertices: usize, faces: &mut Vec<Face>) -> Result<(), MeshError> {
    let first = corner(line, vertices)?;
    let mut previous = corner(line, vertices)?;
    loop {
        let next = corner(line, vertices)?;
        faces.push((line.line(), [first, previous, next]));
        previous = next;
        if line.peek().is_none() {
            return Ok(());
        }
    }
}

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`; a negative index counts back from the latest vertex. Returns it as counted from 1.
fn corner(line: &mut Words, vertices: usize) -> Result<i64, MeshError> {
    let word = line.word("the third vertex of a face")?;
    let index = word.split('/').next().unwrap_or(word);
    match index.parse::<i64>() {
        Ok(index) if index < 0 => Ok(vertices as i64 + 1 + index),
        Ok(index) => Ok(index),
        Err(_) => Err(line.error(Problem::NotA { word: word.to_owned(), expected: "the index of a vertex" })),
    }
}
