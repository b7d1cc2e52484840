//! Stereolithography files, text and binary. Source: 3D Systems, StereoLithography Interface Specification (1989).

use std::collections::HashMap;
use std::path::Path;

use nalgebra::Vector3;

use super::readable;
use super::words::Words;
use crate::{MeshError, Problem, SurfaceMesh};

/// Bytes before the triangles of a binary file: a title and their number.
const HEAD: usize = 84;

/// Bytes of a triangle: a normal, three corners of three 32-bit numbers, and two bytes that have no meaning.
const TRIANGLE: usize = 50;

/// Reads the triangles. Corners at exactly one place become one vertex; a triangle that has a corner twice has no area and is left out.
/// Normals are not read: the order of the corners tells the side.
pub(super) fn read(file: &Path, bytes: Vec<u8>) -> Result<SurfaceMesh, MeshError> {
    let corners = if is_text(&bytes) { text(file, &readable(bytes))? } else { binary(file, &bytes)? };
    if corners.is_empty() {
        return Err(MeshError::in_file(file, Problem::Empty { what: "faces" }));
    }
    Ok(merged(corners))
}

/// A text begins with `solid` and has a `facet` or its end next; some binary files have a title that begins with `solid` as well.
fn is_text(bytes: &[u8]) -> bool {
    let fits = |count: usize| bytes.len() == HEAD.saturating_add(count.saturating_mul(TRIANGLE));
    let count = bytes.get(80..HEAD).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes);
    bytes.trim_ascii_start().starts_with(b"solid") && !count.is_some_and(|count| fits(count as usize))
}

fn text(file: &Path, text: &str) -> Result<Vec<[Vector3<f64>; 3]>, MeshError> {
    let mut corners = Vec::new();
    for mut line in Words::of_lines(file, text) {
        if line.next().is_some_and(|word| word.eq_ignore_ascii_case("vertex")) {
            corners.push((line.line(), line.place()?));
        }
    }
    let (triangles, rest) = corners.as_chunks::<3>();
    if let Some((line, _)) = rest.first() {
        let expected = "the third vertex of a facet";
        return Err(MeshError::in_line(file, *line, Problem::Ends { expected }));
    }
    Ok(triangles.iter().map(|triangle| triangle.map(|(_, place)| place)).collect())
}

fn binary(file: &Path, bytes: &[u8]) -> Result<Vec<[Vector3<f64>; 3]>, MeshError> {
    let Some((head, triangles)) = bytes.split_at_checked(HEAD) else {
        let found = format!("a file of {} bytes that does not begin with `solid`", bytes.len());
        return Err(MeshError::in_file(
            file,
            Problem::Unsupported { found, instead: "export the surface as .stl again" },
        ));
    };
    let announced = head[80..].iter().rev().fold(0, |count, byte| count << 8 | usize::from(*byte));
    let found = triangles.len() / TRIANGLE;
    if found < announced {
        return Err(MeshError::in_file(file, Problem::WrongCount { what: "triangles", announced, found }));
    }
    let real = |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    let mut corners = Vec::with_capacity(announced);
    for (number, triangle) in triangles.chunks_exact(TRIANGLE).take(announced).enumerate() {
        let place = |corner: usize| Vector3::from_fn(|i, _| real(&triangle[12 + 12 * corner + 4 * i..]));
        let places = [place(0), place(1), place(2)];
        if places.iter().any(|place| !place.iter().all(|x| x.is_finite())) {
            let word = format!("a corner of triangle {number}");
            return Err(MeshError::in_byte(file, HEAD + TRIANGLE * number, Problem::NotFinite { word }));
        }
        corners.push(places);
    }
    Ok(corners)
}

fn merged(triangles: Vec<[Vector3<f64>; 3]>) -> SurfaceMesh {
    let (mut vertices, mut numbers) = (Vec::new(), HashMap::new());
    let mut number = |place: Vector3<f64>| {
        // Adding zero turns −0 into 0.
        *numbers.entry(<[f64; 3]>::from(place).map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            vertices.push(place);
            vertices.len() - 1
        })
    };
    let numbered: Vec<[usize; 3]> = triangles.into_iter().map(|triangle| triangle.map(&mut number)).collect();
    let elements = numbered.into_iter().filter(|[a, b, c]| a != b && b != c && c != a).collect();
    SurfaceMesh::new(vertices, elements)
}
