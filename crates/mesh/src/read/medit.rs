//! MEDIT's text files. Source: P. Frey, MEDIT: an interactive mesh visualization software, INRIA RT-0253, 2001, appendix.

use std::path::Path;

use super::words::{Words, from_zero};
use crate::{MeshError, Problem, TetrahedralMesh};

/// Reads `Vertices` and `Tetrahedra`, counted from 1, in any order of sections; other sections are skipped up to the next keyword.
pub(super) fn read(file: &Path, text: &str) -> Result<TetrahedralMesh, MeshError> {
    let mut words = Words::of_text(file, text);
    check_version(&mut words)?;
    let mut vertices = Vec::new();
    let mut tetrahedra = Vec::new();
    while let Some(keyword) = words.next() {
        match keyword {
            "End" => break,
            "Dimension" => check_dimension(&mut words)?,
            "Vertices" => section(&mut words, "vertices", 4, |words| {
                vertices.push(words.place()?);
                words.integer("the reference number of a vertex").map(drop)
            })?,
            "Tetrahedra" => section(&mut words, "tetrahedra", 5, |words| {
                let corners = corners(words)?;
                tetrahedra.push((words.line(), corners));
                words.integer("the reference number of a tetrahedron").map(drop)
            })?,
            "Hexahedra" | "HexahedraQ2" | "Prisms" | "Pentahedra" | "Pyramids" | "TetrahedraP2" => {
                refuse_section(&mut words, keyword)?
            }
            _ if is_keyword(keyword) => skip_section(&mut words),
            _ => return Err(words.error(Problem::NotA { word: keyword.to_owned(), expected: "a MEDIT keyword" })),
        }
    }
    // Indices are checked at the end: a file may have its tetrahedra before its vertices.
    let mut elements = Vec::with_capacity(tetrahedra.len());
    for (line, corners) in tetrahedra {
        let in_line = |problem| MeshError::in_line(file, line, problem);
        let [a, b, c, d] = corners.map(|index| from_zero(index, 1, vertices.len()).map_err(in_line));
        elements.push([a?, b?, c?, d?]);
    }
    Ok(TetrahedralMesh::new(vertices, elements))
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

fn check_dimension(words: &mut Words) -> Result<(), MeshError> {
    match words.amount("the dimension")? {
        3 => Ok(()),
        dimension => {
            let found = format!("dimension {dimension}");
            Err(words.error(Problem::Unsupported { found, instead: "give a mesh in space, `Dimension 3`" }))
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

fn corners(words: &mut Words) -> Result<[i64; 4], MeshError> {
    let mut corner = || words.integer("the index of a vertex");
    Ok([corner()?, corner()?, corner()?, corner()?])
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
