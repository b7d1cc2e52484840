//! Pairs of text files of TetGen (tetrahedra) and of Triangle (triangles in the plane). Sources: H. Si, TetGen manual 1.6, section 5.2.1
//! (.node) and 5.2.4 (.ele); J. R. Shewchuk, Triangle's page on .node and .ele files.

use std::path::Path;

use nalgebra::Vector3;

use super::content::Content;
use super::words::{Words, rows};
use super::{extension, text, with_extension};
use crate::{MeshError, Problem};

/// The positions of a file.
struct Nodes {
    /// z is 0 in files of the plane.
    places: Vec<Vector3<f64>>,
    /// Number of the first, 0 or 1.
    first: i64,
    dimension: usize,
}

/// Reads `path` and its partner of the same stem. All numbers count from that of the first node, 0 or 1.
pub(super) fn read(path: &Path) -> Result<Content, MeshError> {
    let (node_file, ele_file) = match extension(path).as_str() {
        "node" => (path.to_owned(), with_extension(path, "ele")),
        _ => (with_extension(path, "node"), path.to_owned()),
    };
    let partner = if node_file == path { &ele_file } else { &node_file };
    if !partner.exists() {
        // If both are missing, the error names the requested one.
        text(path)?;
        return Err(MeshError::in_file(path, Problem::PartnerMissing { partner: partner.clone() }));
    }
    let nodes = nodes(&node_file, &text(&node_file)?)?;
    let text = text(&ele_file)?;
    let mut content = Content::default();
    if nodes.dimension == 2 {
        let instead = "run triangle without -o2";
        content.triangles = elements(&ele_file, &text, &nodes, ["triangles", "the number of triangles", instead])?;
    } else {
        let instead = "run tetgen without -o2";
        content.tetrahedra = elements(&ele_file, &text, &nodes, ["tetrahedra", "the number of tetrahedra", instead])?;
    }
    content.vertices = nodes.places;
    Ok(content)
}

/// `<nodes> <dimension> <attributes> <markers>`, then `<number> <x> <y> <z> …` for each, without z in two dimensions.
fn nodes(file: &Path, text: &str) -> Result<Nodes, MeshError> {
    let mut lines = Words::of_lines(file, text);
    let mut header = lines.next().ok_or_else(|| MeshError::in_file(file, Problem::Empty { what: "nodes" }))?;
    let announced = header.amount("the number of nodes")?;
    let dimension = if header.peek().is_some() { header.amount("the dimension")? } else { 3 };
    if ![2, 3].contains(&dimension) {
        let found = format!("the dimension {dimension}");
        return Err(
            header.error(Problem::Unsupported { found, instead: "give a mesh in the plane (2) or in space (3)" })
        );
    }
    let mut first = 0;
    let places = rows(file, &mut lines, "nodes", announced, |row, line| {
        let number = line.integer("the number of a node")?;
        if row == 0 && (number == 0 || number == 1) {
            first = number;
        }
        consecutive(line, number, first, row)?;
        if dimension == 2 { line.place_in_plane() } else { line.place() }
    })?;
    no_more(file, lines, "nodes", announced)?;
    Ok(Nodes { places, first, dimension })
}

/// `<elements> <nodes of each> <attributes>`, then `<number> <a> <b> <c> …` for each. `words` are the elements' name, their number, and
/// the remedy if they have more nodes than corners.
fn elements<const N: usize>(
    file: &Path,
    text: &str,
    nodes: &Nodes,
    [what, amount, instead]: [&'static str; 3],
) -> Result<Vec<[usize; N]>, MeshError> {
    let mut lines = Words::of_lines(file, text);
    let mut header = lines.next().ok_or_else(|| MeshError::in_file(file, Problem::Empty { what }))?;
    let announced = header.amount(amount)?;
    let corners = if header.peek().is_some() { header.amount("the number of nodes of each element")? } else { N };
    if corners != N {
        let found = format!("a mesh of elements with {corners} nodes, and nodes of dimension {},", N - 1);
        return Err(header.error(Problem::Unsupported { found, instead }));
    }
    let elements = rows(file, &mut lines, what, announced, |row, line| {
        let number = line.integer("the number of an element")?;
        consecutive(line, number, nodes.first, row)?;
        let mut element = [0; N];
        for vertex in &mut element {
            *vertex = line.index(nodes.first, nodes.places.len())?;
        }
        Ok(element)
    })?;
    no_more(file, lines, what, announced)?;
    Ok(elements)
}

fn consecutive(line: &Words, found: i64, first: i64, row: usize) -> Result<(), MeshError> {
    let expected = first + row as i64;
    if found == expected { Ok(()) } else { Err(line.error(Problem::NotConsecutive { expected, found })) }
}

fn no_more<'a>(
    file: &Path,
    lines: impl Iterator<Item = Words<'a>>,
    what: &'static str,
    announced: usize,
) -> Result<(), MeshError> {
    match lines.count() {
        0 => Ok(()),
        more => Err(MeshError::in_file(file, Problem::WrongCount { what, announced, found: announced + more })),
    }
}
