//! Wavefront's text files. Source: Wavefront Technologies, Object Files (.obj), Advanced Visualizer manual, appendix B1.

use std::borrow::Cow;
use std::path::Path;

use nalgebra::Vector3;

use super::content::Content;
use super::words::{Words, from_zero};
use crate::{MeshError, Problem};

/// The line of a triangle and its vertex indices.
type Face = (usize, [i64; 3]);

/// Reads `v`, `f`, and `g` and `o` as sets; textures, normals and materials do not change the shape.
///
/// A polygon becomes a fan around its first vertex. A face of fewer than three vertices is left out.
pub(super) fn read(file: &Path, text: &str) -> Result<Content, MeshError> {
    let mut content = Content { is_surface: true, ..Content::default() };
    let (mut faces, mut has_weights): (Vec<Face>, Option<bool>) = (Vec::new(), None);
    // Names of the current object and groups, and the parts that they have.
    let (mut object, mut groups): (Option<String>, Vec<String>) = Default::default();
    for mut line in Words::of_lines(file, &joined(text)) {
        match line.next().unwrap_or_default() {
            "v" => content.vertices.push(vertex(&mut line, &mut has_weights)?),
            "f" => {
                let first = faces.len();
                content.short_faces += usize::from(!polygon(&mut line, content.vertices.len(), &mut faces)?);
                for name in groups.iter().chain(&object) {
                    content.groups.entry(name.clone()).or_default().triangles.extend(first..faces.len());
                }
            }
            "g" => groups = line.filter(|name| *name != "default").map(str::to_owned).collect(),
            "o" => object = Some(line.rest().trim().to_owned()).filter(|name| !name.is_empty()),
            "vt" => content.notes.unread("texture coordinates (vt)"),
            "vn" => content.notes.unread("normals (vn)"),
            "usemtl" | "mtllib" => content.notes.unread("materials (usemtl)"),
            "s" | "vp" => {}
            other => content.notes.unread(format!("the lines `{other}`")),
        }
    }
    // Indices are checked at the end: a face may stand before its vertices.
    content.triangles.reserve_exact(faces.len());
    for (line, corners) in faces {
        let in_line = |problem| MeshError::in_line(file, line, problem);
        let [a, b, c] = corners.map(|index| from_zero(index, 1, content.vertices.len()).map_err(in_line));
        content.triangles.push([a?, b?, c?]);
    }
    // A group of all triangles tells no parts.
    let all = content.triangles.len();
    content.groups.retain(|_, parts| parts.triangles.len() < all);
    Ok(content)
}

/// The text with the lines that end in a backslash joined to the next one; lines keep their numbers.
fn joined(text: &str) -> Cow<'_, str> {
    if !text.contains("\\\n") && !text.contains("\\\r\n") {
        return Cow::Borrowed(text);
    }
    let (mut all, mut ends) = (String::with_capacity(text.len()), 1);
    for line in text.lines() {
        if let Some(start) = line.strip_suffix('\\') {
            all.extend([start, " "]);
            ends += 1;
        } else {
            all += line;
            all.extend(std::iter::repeat_n('\n', std::mem::replace(&mut ends, 1)));
        }
    }
    Cow::Owned(all)
}

/// `x y z`, then nothing, three or four numbers of a colour, or a weight, which all vertices have or none: a single row with one number more
/// is a broken one.
fn vertex(line: &mut Words, has_weights: &mut Option<bool>) -> Result<Vector3<f64>, MeshError> {
    let (place, extra) = (line.place()?, line.clone().count());
    let is_same = *has_weights.get_or_insert(extra == 1) == (extra == 1);
    if is_same && [0, 1, 3, 4].contains(&extra) {
        return Ok(place);
    }
    line.end("a vertex")?;
    Err(line.error(Problem::Ends { expected: "the weight that the first vertex has" }))
}

/// Adds a polygon as triangles. Returns false if it has fewer than three corners.
fn polygon(line: &mut Words, vertices: usize, faces: &mut Vec<Face>) -> Result<bool, MeshError> {
    if line.clone().count() < 3 {
        return Ok(false);
    }
    let first = corner(line, vertices)?;
    let mut previous = corner(line, vertices)?;
    while line.peek().is_some() {
        let next = corner(line, vertices)?;
        faces.push((line.line(), [first, previous, next]));
        previous = next;
    }
    Ok(true)
}

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`; a negative index counts back from the latest vertex. Returns it as counted from 1.
fn corner(line: &mut Words, vertices: usize) -> Result<i64, MeshError> {
    let word = line.word("a vertex of a face")?;
    let index = word.split('/').next().unwrap_or(word);
    match index.parse::<i64>() {
        Ok(index) if index < 0 => Ok(vertices as i64 + 1 + index),
        Ok(index) => Ok(index),
        Err(_) => Err(line.error(Problem::NotA { word: word.to_owned(), expected: "the index of a vertex" })),
    }
}
