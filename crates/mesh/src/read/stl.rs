//! Stereolithography files, text and binary. Source: 3D Systems, StereoLithography Interface Specification (1989).

use std::collections::HashMap;
use std::path::Path;

use nalgebra::Vector3;

use super::content::Content;
use super::readable;
use super::words::Words;
use crate::connectivity::bits;
use crate::{MeshError, Problem};

/// Bytes before the triangles of a binary file: a title and their number.
const HEAD: usize = 84;

/// Bytes of a triangle: a normal, three corners of three 32-bit numbers, and two bytes that have no meaning.
const TRIANGLE: usize = 50;

/// Reads the triangles. Corners at exactly one place become one vertex. Several solids of a text become sets. Normals are not read: the order
/// of the corners tells the side.
pub(super) fn read(file: &Path, bytes: Vec<u8>) -> Result<Content, MeshError> {
    let mut content = Content { is_surface: true, ..Content::default() };
    let corners =
        if is_text(&bytes) { text(file, &readable(bytes), &mut content)? } else { binary(file, &bytes, &mut content)? };
    (content.vertices, content.triangles) = merged(corners);
    Ok(content)
}

/// A text begins with `solid` and has a `facet` or its end next; some binary files have a title that begins with `solid` as well.
fn is_text(bytes: &[u8]) -> bool {
    let fits = |count: usize| bytes.len() == HEAD.saturating_add(count.saturating_mul(TRIANGLE));
    let count = bytes.get(80..HEAD).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes);
    let start = bytes.trim_ascii_start().get(..5).unwrap_or_default();
    start.eq_ignore_ascii_case(b"solid") && !count.is_some_and(|count| fits(count as usize))
}

/// The lines `facet normal x y z`, `outer loop`, three times `vertex x y z`, `endloop` and `endfacet`, for each triangle.
fn text(file: &Path, text: &str, content: &mut Content) -> Result<Vec<[Vector3<f64>; 3]>, MeshError> {
    let (mut triangles, mut corners) = (Vec::new(), Vec::new());
    // Names of the solids, and the ends of their triangles.
    let mut solids: Vec<(String, usize)> = Vec::new();
    let (mut is_in_facet, mut is_in_solid) = (false, false);
    for mut line in Words::of_lines(file, text) {
        let keyword = line.next().unwrap_or_default().to_ascii_lowercase();
        let misplaced = |is_wrong: bool, expected: &'static str| match is_wrong {
            true => Err(line.error(Problem::NotA { word: keyword.clone(), expected })),
            false => Ok(()),
        };
        match &keyword[..] {
            "vertex" => {
                misplaced(!is_in_facet || corners.len() == 3, "`endfacet`: a facet has three vertices")?;
                corners.push(line.place()?);
                line.end("the three coordinates of a vertex")?;
            }
            "facet" => {
                misplaced(is_in_facet, "`endfacet`: a facet has three vertices")?;
                is_in_facet = true;
            }
            "endfacet" => {
                let [a, b, c] = corners[..] else {
                    return Err(line.error(Problem::Ends { expected: "the third vertex of a facet" }));
                };
                triangles.push([a, b, c]);
                corners.clear();
                is_in_facet = false;
            }
            "solid" => {
                misplaced(is_in_facet, "`endfacet`: a facet has three vertices")?;
                is_in_solid = true;
                solids.push((line.rest().trim().to_owned(), 0));
            }
            "endsolid" => {
                misplaced(is_in_facet, "`endfacet`: a facet has three vertices")?;
                is_in_solid = false;
                solids.last_mut().into_iter().for_each(|(_, end)| *end = triangles.len());
            }
            "outer" | "endloop" => {}
            _ => misplaced(
                true,
                "a line of an .stl file: solid, facet, outer loop, vertex, endloop, endfacet or endsolid",
            )?,
        }
    }
    if is_in_facet {
        return Err(MeshError::in_file(file, Problem::Ends { expected: "`endfacet` of the last facet" }));
    }
    if is_in_solid {
        content.notes.tell("`endsolid` is missing at the end: the file may be cut short".to_owned());
    }
    let mut start = 0;
    for (name, end) in solids.into_iter().filter(|(name, end)| !name.is_empty() && *end < triangles.len().max(1)) {
        content.groups.entry(name).or_default().triangles.extend(start..end.max(start));
        start = end.max(start);
    }
    Ok(triangles)
}

fn binary(file: &Path, bytes: &[u8], content: &mut Content) -> Result<Vec<[Vector3<f64>; 3]>, MeshError> {
    let Some((head, triangles)) = bytes.split_at_checked(HEAD) else {
        let found = format!("a file of {} bytes that does not begin with `solid`", bytes.len());
        return Err(MeshError::in_file(
            file,
            Problem::Unsupported { found, instead: "export the surface as .stl again" },
        ));
    };
    let announced = head[80..].iter().rev().fold(0, |count, byte| count << 8 | usize::from(*byte));
    let found = triangles.len() / TRIANGLE;
    if found != announced {
        return Err(MeshError::in_file(file, Problem::WrongCount { what: "triangles", announced, found }));
    }
    if triangles.len() > announced * TRIANGLE {
        content.notes.unread(format!("{} bytes after the last triangle", triangles.len() - announced * TRIANGLE));
    }
    let real = |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    let mut corners = Vec::with_capacity(announced);
    for (number, triangle) in triangles.chunks_exact(TRIANGLE).enumerate() {
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

/// The places, each once, and the triangles by their numbers.
fn merged(triangles: Vec<[Vector3<f64>; 3]>) -> (Vec<Vector3<f64>>, Vec<[usize; 3]>) {
    let (mut vertices, mut numbers) = (Vec::new(), HashMap::new());
    let mut number = |place: Vector3<f64>| {
        *numbers.entry(bits(&place)).or_insert_with(|| {
            vertices.push(place);
            vertices.len() - 1
        })
    };
    let numbered = triangles.into_iter().map(|triangle| triangle.map(&mut number)).collect();
    (vertices, numbered)
}
