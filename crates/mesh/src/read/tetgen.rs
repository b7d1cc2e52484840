//! TetGen's pair of text files. Source: H. Si, TetGen manual 1.6, section 5.2.1 (.node) and 5.2.4 (.ele).

use std::path::Path;

use nalgebra::Vector3;

use super::words::{Words, rows};
use super::{extension, text, with_extension};
use crate::{MeshError, Problem, TetrahedralMesh};

/// Reads `path` and its partner of the same stem. All numbers count from that of the first node, 0 or 1.
pub(super) fn read(path: &Path) -> Result<TetrahedralMesh, MeshError> {
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
    let (vertices, first) = nodes(&node_file, &text(&node_file)?)?;
    let elements = elements(&ele_file, &text(&ele_file)?, first, vertices.len())?;
    Ok(TetrahedralMesh::new(vertices, elements))
}

/// `<nodes> <dimension> <attributes> <markers>`, then `<number> <x> <y> <z> …` for each. Returns the first number too.
fn nodes(file: &Path, text: &str) -> Result<(Vec<Vector3<f64>>, i64), MeshError> {
    let mut lines = Words::of_lines(file, text);
    let mut header = lines.next().ok_or_else(|| MeshError::in_file(file, Problem::Empty { what: "nodes" }))?;
    let announced = header.amount("the number of nodes")?;
    if header.peek().is_some() && header.amount("the dimension")? != 3 {
        let found = "a dimension other than 3".to_owned();
        return Err(header.error(Problem::Unsupported { found, instead: "give a mesh in space" }));
    }
    let mut first = 0;
    let nodes = rows(file, &mut lines, "nodes", announced, |row, line| {
        let number = line.integer("the number of a node")?;
        if row == 0 && (number == 0 || number == 1) {
            first = number;
        }
        consecutive(line, number, first, row)?;
        line.place()
    })?;
    no_more(file, lines, "nodes", announced)?;
    Ok((nodes, first))
}

/// `<tetrahedra> <nodes of each> <attributes>`, then `<number> <a> <b> <c> <d> …` for each.
fn elements(file: &Path, text: &str, first: i64, nodes: usize) -> Result<Vec<[usize; 4]>, MeshError> {
    let mut lines = Words::of_lines(file, text);
    let mut header = lines.next().ok_or_else(|| MeshError::in_file(file, Problem::Empty { what: "tetrahedra" }))?;
    let announced = header.amount("the number of tetrahedra")?;
    if header.peek().is_some() && header.amount("the number of nodes of each tetrahedron")? != 4 {
        let found = "a mesh whose tetrahedra have more than 4 nodes".to_owned();
        return Err(header.error(Problem::Unsupported { found, instead: "run tetgen without -o2" }));
    }
    let tetrahedra = rows(file, &mut lines, "tetrahedra", announced, |row, line| {
        let number = line.integer("the number of a tetrahedron")?;
        consecutive(line, number, first, row)?;
        Ok([line.index(first, nodes)?, line.index(first, nodes)?, line.index(first, nodes)?, line.index(first, nodes)?])
    })?;
    no_more(file, lines, "tetrahedra", announced)?;
    Ok(tetrahedra)
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
