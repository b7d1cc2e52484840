//! MEDIT's text files. Source: P. Frey, MEDIT: an interactive mesh visualization software, INRIA RT-0253, 2001, appendix.

use std::path::Path;

use super::content::{Content, Entry};
use super::words::{Words, from_zero};
use crate::{MeshError, Problem};

/// An element's vertices counted from 1, its reference and its line.
type Row<const N: usize> = ([i64; N], i32, u32);

const REFERENCE: &str = "the reference number of an entry, an integer";

/// Reads `Vertices`, `Tetrahedra`, `Triangles`, `Quadrilaterals` and `Edges`, counted from 1, in any order of sections; other sections are
/// skipped up to the next keyword. References make sets. Files of dimension 2 have z = 0.
pub(super) fn read(file: &Path, text: &str) -> Result<Content, MeshError> {
    let mut words = Words::of_text(file, text);
    check_version(&mut words)?;
    let (mut content, mut dimension) = (Content::default(), 3);
    content.name_tags_from(text);
    let (mut tetrahedra, mut triangles): (Vec<Row<4>>, Vec<Row<3>>) = Default::default();
    let (mut quadrangles, mut edges): (Vec<Row<4>>, Vec<Row<2>>) = Default::default();
    while let Some(keyword) = words.next() {
        match &keyword.to_ascii_lowercase()[..] {
            "end" => break,
            "dimension" => dimension = read_dimension(&mut words)?,
            "vertices" => section(&mut words, "vertices", dimension + 1, |words| {
                content.vertices.push(if dimension == 2 { words.place_in_plane()? } else { words.place()? });
                content.node_tags.push(words.tag(REFERENCE)?);
                Ok(())
            })?,
            "tetrahedra" => rows(&mut words, "tetrahedra", &mut tetrahedra)?,
            "triangles" => rows(&mut words, "triangles", &mut triangles)?,
            "quadrilaterals" => rows(&mut words, "quadrilaterals", &mut quadrangles)?,
            "edges" => rows(&mut words, "edges", &mut edges)?,
            "quadrilateralsq2" | "trianglesp2" => {
                let count = words.amount("the number of entries")?;
                skip_section(&mut words);
                let found = (count > 0).then(|| format!("a surface with {count} {keyword}"));
                content.skipped = found.or(content.skipped);
            }
            "hexahedra" | "hexahedraq2" | "prisms" | "pentahedra" | "pyramids" | "tetrahedrap2" => {
                refuse_section(&mut words, keyword)?
            }
            _ if is_keyword(keyword) => {
                skip_section(&mut words);
                content.notes.unread(format!("the section {keyword}"));
            }
            _ => return Err(words.error(Problem::NotA { word: keyword.to_owned(), expected: "a MEDIT keyword" })),
        }
    }
    // Indices are checked at the end: a file may have its elements before its vertices.
    content.tetrahedra.reserve_exact(tetrahedra.len());
    content.triangles.reserve_exact(triangles.len());
    elements(&mut content, file, tetrahedra, Content::tetrahedron)?;
    elements(&mut content, file, triangles, |content, corners| content.polygon(&corners))?;
    elements(&mut content, file, quadrangles, |content, corners| content.polygon(&corners))?;
    elements(&mut content, file, edges, |_, corners| Entry::edge(corners))?;
    Ok(content)
}

fn elements<const N: usize>(
    content: &mut Content,
    file: &Path,
    rows: Vec<Row<N>>,
    add: impl Fn(&mut Content, [usize; N]) -> Entry,
) -> Result<(), MeshError> {
    let vertices = content.vertices.len();
    for (corners, reference, line) in rows {
        let mut element = [0; N];
        for (vertex, index) in element.iter_mut().zip(corners) {
            let in_line = |problem| MeshError::in_line(file, line as usize, problem);
            *vertex = from_zero(index, 1, vertices).map_err(in_line)?;
        }
        let entry = add(content, element);
        content.tag(reference.into(), entry);
    }
    Ok(())
}

/// The versions differ only in the width of numbers in binary files.
fn check_version(words: &mut Words) -> Result<(), MeshError> {
    let instead = "save the mesh as a MEDIT text file, which starts with `MeshVersionFormatted 2`";
    match words.word("the keyword MeshVersionFormatted")? {
        keyword if keyword.eq_ignore_ascii_case("MeshVersionFormatted") => {}
        _ => {
            return Err(words.error(Problem::Unsupported {
                found: "a .mesh file that is not MEDIT's text format".to_owned(),
                instead,
            }));
        }
    }
    match words.amount("the version of the format")? {
        0..=4 => Ok(()),
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

/// A count, then as many entries of `width` words. A line holds whole entries.
fn section<'a>(
    words: &mut Words<'a>,
    what: &'static str,
    width: usize,
    mut entry: impl FnMut(&mut Words<'a>) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    let announced = words.amount("the number of entries")?;
    let start = words.clone();
    let broken =
        |row: &Words<'a>| row.error(Problem::BrokenRow { what, expected: width, found: words_of_line(row.clone()) });
    // The first word of the current line.
    let mut row = words.clone();
    for found in 0..announced {
        let mut first = words.clone();
        if first.next().is_none_or(is_keyword) {
            return Err(start.error(Problem::WrongCount { what, announced, found }));
        }
        row = if first.line() == row.line() && found > 0 { row } else { first };
        entry(words)?;
        if words.line() != row.line() {
            return Err(broken(&row));
        }
    }
    let mut next = words.clone();
    if next.next().is_none_or(is_keyword) {
        return Ok(());
    }
    if next.line() == words.line() && announced > 0 {
        return Err(broken(&row));
    }
    let more = words.clone().take_while(|word| !is_keyword(word)).count();
    Err(start.error(Problem::WrongCount { what, announced, found: announced + more.div_ceil(width) }))
}

/// Number of the words of a line, of which the first has been taken.
fn words_of_line(mut words: Words) -> usize {
    let (line, mut count) = (words.line(), 1);
    while words.next().is_some() && words.line() == line {
        count += 1;
    }
    count
}

/// A section of elements.
fn rows<const N: usize>(words: &mut Words, what: &'static str, rows: &mut Vec<Row<N>>) -> Result<(), MeshError> {
    let announced = words.clone().amount("the number of entries")?;
    // A word and a blank take two bytes.
    rows.reserve_exact(announced.min(words.rest().len() / (2 * N + 2)));
    section(words, what, N + 1, |words| row(words).map(|row| rows.push(row)))
}

fn row<const N: usize>(words: &mut Words) -> Result<Row<N>, MeshError> {
    let mut corners = [0; N];
    for corner in &mut corners {
        *corner = words.integer("the index of a vertex")?;
    }
    // A file with more than 2³² lines fits into no memory.
    Ok((corners, words.tag(REFERENCE)?, words.line() as u32))
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

/// Skips a section, in which a text in quotation marks may have words like keywords.
fn skip_section(words: &mut Words) {
    while let Some(word) = words.peek().filter(|word| !is_keyword(word)) {
        words.next();
        let mut is_open = word.matches('"').count() % 2 == 1;
        while is_open && let Some(word) = words.next() {
            is_open = word.matches('"').count() % 2 == 0;
        }
    }
}

/// Returns true for a word that starts with a letter, apart from the numbers `nan` and `inf`.
fn is_keyword(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_alphabetic()) && word.parse::<f64>().is_err()
}
