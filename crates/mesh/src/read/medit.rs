//! MEDIT's text files. Source: P. Frey, MEDIT: an interactive mesh visualization software, INRIA RT-0253, 2001, appendix.

use std::path::Path;

use super::content::Content;
use super::words::{Words, from_zero};
use crate::{MeshError, Problem};

/// An element's line, and its vertices counted from 1.
type Row<const N: usize> = (usize, [i64; N]);

/// Reads `Vertices`, `Tetrahedra` and `Triangles`, counted from 1, in any order of sections; other sections are skipped up to the
/// next keyword. Files of dimension 2 have z = 0.
pub(super) fn read(file: &Path, text: &str) -> Result<Content, MeshError> {
    let mut words = Words::of_text(file, text);
    check_version(&mut words)?;
    let (mut content, mut dimension) = (Content::default(), 3);
    let (mut tetrahedra, mut triangles): (Vec<Row<4>>, Vec<Row<3>>) = Default::default();
    while let Some(keyword) = words.next() {
        match keyword {
            "End" => break,
            "Dimension" => dimension = read_dimension(&mut words)?,
            "Vertices" => section(&mut words, "vertices", dimension + 1, |words| {
                content.vertices.push(if dimension == 2 { words.place_in_plane()? } else { words.place()? });
                words.integer("the reference number of a vertex").map(drop)
            })?,
            "Tetrahedra" => section(&mut words, "tetrahedra", 5, |words| {
                tetrahedra.push(row(words)?);
                words.integer("the reference number of a tetrahedron").map(drop)
            })?,
            "Triangles" => section(&mut words, "triangles", 4, |words| {
                triangles.push(row(words)?);
                words.integer("the reference number of a triangle").map(drop)
            })?,
            "Quadrilaterals" | "QuadrilateralsQ2" | "TrianglesP2" => {
                content.skipped = polygons(&mut words, keyword)?.or(content.skipped);
            }
            "Hexahedra" | "HexahedraQ2" | "Prisms" | "Pentahedra" | "Pyramids" | "TetrahedraP2" => {
                refuse_section(&mut words, keyword)?
            }
            _ if is_keyword(keyword) => skip_section(&mut words),
            _ => return Err(words.error(Problem::NotA { word: keyword.to_owned(), expected: "a MEDIT keyword" })),
        }
    }
    // Indices are checked at the end: a file may have its elements before its vertices.
    content.tetrahedra = elements(file, tetrahedra, content.vertices.len())?;
    if content.tetrahedra.is_empty() {
        content.triangles = elements(file, triangles, content.vertices.len())?;
    }
    Ok(content)
}

fn elements<const N: usize>(file: &Path, rows: Vec<Row<N>>, vertices: usize) -> Result<Vec<[usize; N]>, MeshError> {
    let element = |(line, corners): Row<N>| {
        let mut element = [0; N];
        for (vertex, index) in element.iter_mut().zip(corners) {
            *vertex = from_zero(index, 1, vertices).map_err(|problem| MeshError::in_line(file, line, problem))?;
        }
        Ok(element)
    };
    rows.into_iter().map(element).collect()
}

/// The four versions differ only in the width of numbers in binary files.
fn check_version(words: &mut Words) -> Result<(), MeshError> {
    let instead = "save the mesh as a MEDIT text file, which starts with `MeshVersionFormatted 2`";
    match words.word("the keyword MeshVersionFormatted")? {
        "MeshVersionFormatted" => {}
        _ => {
            return Err(words.error(Problem::Unsupported {
                found: "a .mesh file that is not MEDIT's text format".to_owned(),
                instead,
            }));
        }
    }
    match words.amount("the version of the format")? {
        1..=4 => Ok(()),
        version => Err(words.error(Problem::Unsupported { found: format!("MEDIT version {version}"), instead })),
    }
}

fn read_dimension(words: &mut Words) -> Result<usize, MeshError> {
    match words.amount("the dimension")? {
        dimension @ (2 | 3) => Ok(dimension),
        dimension => {
            let found = format!("dimension {dimension}");
            Err(words.error(Problem::Unsupported { found, instead: "give a mesh of `Dimension 2` or `Dimension 3`" }))
        }
    }
}

/// A count, then as many entries of `width` words.
fn section<'a>(
    words: &mut Words<'a>,
    what: &'static str,
    width: usize,
    mut entry: impl FnMut(&mut Words<'a>) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    let announced = words.amount("the number of entries")?;
    let start = words.clone();
    for found in 0..announced {
        if words.peek().is_none_or(is_keyword) {
            return Err(start.error(Problem::WrongCount { what, announced, found }));
        }
        entry(words)?;
    }
    match words.clone().take_while(|word| !is_keyword(word)).count() {
        0 => Ok(()),
        more => Err(start.error(Problem::WrongCount { what, announced, found: announced + more.div_ceil(width) })),
    }
}

fn row<const N: usize>(words: &mut Words) -> Result<Row<N>, MeshError> {
    let mut corners = [0; N];
    for corner in &mut corners {
        *corner = words.integer("the index of a vertex")?;
    }
    Ok((words.line(), corners))
}

/// Skips polygons that are no triangles. Returns a description if there are some: in a surface they would leave holes.
fn polygons(words: &mut Words, keyword: &str) -> Result<Option<String>, MeshError> {
    let count = words.amount("the number of entries")?;
    skip_section(words);
    Ok((count > 0).then(|| format!("a surface with {count} {keyword}")))
}

/// Returns an error for a section with entries: skipped volume elements would leave holes in the body.
fn refuse_section(words: &mut Words, keyword: &str) -> Result<(), MeshError> {
    match words.amount("the number of entries")? {
        0 => Ok(()),
        count => {
            let found = format!("a mesh with {count} {keyword}");
            Err(words.error(Problem::Unsupported { found, instead: "export tetrahedra with 4 nodes instead" }))
        }
    }
}

fn skip_section(words: &mut Words) {
    while words.peek().is_some_and(|word| !is_keyword(word)) {
        words.next();
    }
}

/// Returns true for a word that starts with a letter, apart from the numbers `nan` and `inf`.
fn is_keyword(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_alphabetic()) && word.parse::<f64>().is_err()
}
