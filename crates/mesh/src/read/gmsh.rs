//! Gmsh's text files, versions 4.0 and 4.1. Source: Gmsh reference manual, section «MSH file format» and its appendix.

use std::collections::HashMap;
use std::path::Path;

use nalgebra::Vector3;

use super::words::{Words, rows};
use crate::{MeshError, Problem, TetrahedralMesh};

/// Gmsh's number for the tetrahedron with 4 nodes.
const TETRAHEDRON: usize = 4;

const CONVERT: &str = "convert it with `gmsh IN.msh -0 -format msh41 -setnumber Mesh.Binary 0 -o OUT.msh`";
const SPLIT: &str = "mesh the volumes with tetrahedra of first order (`gmsh -3 -order 1`)";

/// The two supported layouts, which differ in the order of a few numbers.
#[derive(Clone, Copy, PartialEq)]
enum Version {
    V40,
    V41,
}

#[derive(Default)]
struct Nodes {
    places: Vec<Vector3<f64>>,
    /// From a node's tag, any integer, to its index in `places`.
    index: HashMap<i64, usize>,
}

/// Reads the tetrahedra of all entities. Points, lines and faces are skipped; other volume elements are an error.
pub(super) fn read(file: &Path, text: &str) -> Result<TetrahedralMesh, MeshError> {
    let mut lines = Words::of_lines(file, text);
    let version = read_version(file, &mut lines)?;
    let mut nodes = Nodes::default();
    let mut elements = Vec::new();
    while let Some(mut line) = lines.next() {
        match line.word("a section")? {
            "$Nodes" => read_nodes(file, &mut lines, version, &mut nodes)?,
            "$Elements" => read_elements(file, &mut lines, version, &nodes, &mut elements)?,
            // Other sections are skipped line by line.
            _ => {}
        }
    }
    Ok(TetrahedralMesh { vertices: nodes.places, elements })
}

fn read_version<'a>(file: &Path, lines: &mut impl Iterator<Item = Words<'a>>) -> Result<Version, MeshError> {
    let unsupported = |found: String| Problem::Unsupported { found, instead: CONVERT };
    let missing = || MeshError::in_file(file, unsupported("a file without the section $MeshFormat".to_owned()));
    lines.find(|line| line.peek() == Some("$MeshFormat")).ok_or_else(missing)?;
    let mut line = next_line(file, lines, "the version")?;
    let version = line.word("the version")?;
    if line.amount("the kind of file, 0 for text")? != 0 {
        return Err(line.error(unsupported("a binary Gmsh file".to_owned())));
    }
    match version {
        "4.1" => Ok(Version::V41),
        "4" | "4.0" => Ok(Version::V40),
        _ => Err(line.error(unsupported(format!("Gmsh format {version}")))),
    }
}

/// `<blocks> <nodes> …`, then blocks of `<dim> <tag> <parametric> <nodes>`; all tags stand before all positions (4.1),
/// or each tag beside its position (4.0).
fn read_nodes<'a>(
    file: &Path,
    lines: &mut impl Iterator<Item = Words<'a>>,
    version: Version,
    nodes: &mut Nodes,
) -> Result<(), MeshError> {
    let (blocks, announced) = section_header(file, lines)?;
    for _ in 0..blocks {
        let mut header = next_line(file, lines, "a block of nodes")?;
        for _ in 0..3 {
            header.integer("an integer of the block")?;
        }
        let count = header.amount("the number of nodes of the block")?;
        if version == Version::V41 {
            let first = nodes.places.len();
            rows(file, lines, "nodes", count, |row, line| {
                add_tag(line, nodes, first + row)?;
                // A line with more numbers is a position.
                let short = Problem::WrongCount { what: "node tags", announced: count, found: row };
                if line.peek().is_some() { Err(line.error(short)) } else { Ok(()) }
            })?;
            nodes.places.extend(rows(file, lines, "nodes", count, |_, line| line.place())?);
        } else {
            rows(file, lines, "nodes", count, |_, line| {
                let index = nodes.places.len();
                add_tag(line, nodes, index)?;
                nodes.places.push(line.place()?);
                Ok(())
            })?;
        }
    }
    end_section(file, lines, "nodes", announced, nodes.places.len())
}

fn add_tag(line: &mut Words, nodes: &mut Nodes, index: usize) -> Result<(), MeshError> {
    let tag = line.integer("the tag of a node")?;
    match nodes.index.insert(tag, index) {
        None => Ok(()),
        Some(_) => Err(line.error(Problem::RepeatedTag { tag })),
    }
}

/// `<blocks> <elements> …`, then blocks of `<dim> <tag> <type> <elements>` (4.0: tag first), then `<tag> <nodes …>` each.
fn read_elements<'a>(
    file: &Path,
    lines: &mut impl Iterator<Item = Words<'a>>,
    version: Version,
    nodes: &Nodes,
    elements: &mut Vec<[usize; 4]>,
) -> Result<(), MeshError> {
    let (blocks, announced) = section_header(file, lines)?;
    let mut found = 0;
    for _ in 0..blocks {
        let mut header = next_line(file, lines, "a block of elements")?;
        let (first, second) = (header.integer("an integer of the block")?, header.integer("an integer of the block")?);
        let dimension = if version == Version::V41 { first } else { second };
        let kind = header.amount("the type of the block's elements")?;
        let count = header.amount("the number of elements of the block")?;
        // Skipped volume elements would leave holes in the body.
        if dimension == 3 && kind != TETRAHEDRON && count > 0 {
            let found = match kind {
                11 => "a mesh of tetrahedra with 10 nodes".to_owned(),
                _ => format!("a mesh with volumes other than tetrahedra with 4 nodes (Gmsh's element type {kind})"),
            };
            return Err(header.error(Problem::Unsupported { found, instead: SPLIT }));
        }
        if kind == TETRAHEDRON {
            elements.extend(rows(file, lines, "elements", count, |_, line| tetrahedron(line, nodes))?);
        } else {
            rows(file, lines, "elements", count, |_, _| Ok(()))?;
        }
        found += count;
    }
    end_section(file, lines, "elements", announced, found)
}

fn tetrahedron(line: &mut Words, nodes: &Nodes) -> Result<[usize; 4], MeshError> {
    line.integer("the tag of an element")?;
    let mut corner = || {
        let tag = line.integer("the tag of a node")?;
        nodes.index.get(&tag).copied().ok_or_else(|| line.error(Problem::UnknownTag { tag }))
    };
    Ok([corner()?, corner()?, corner()?, corner()?])
}

fn section_header<'a>(file: &Path, lines: &mut impl Iterator<Item = Words<'a>>) -> Result<(usize, usize), MeshError> {
    let mut line = next_line(file, lines, "the counts of a section")?;
    Ok((line.amount("the number of blocks")?, line.amount("the number of entries")?))
}

fn end_section<'a>(
    file: &Path,
    lines: &mut impl Iterator<Item = Words<'a>>,
    what: &'static str,
    announced: usize,
    read: usize,
) -> Result<(), MeshError> {
    let more = lines.take_while(|line| line.peek().is_none_or(|word| !word.starts_with('$'))).count();
    match read + more {
        found if found == announced => Ok(()),
        found => Err(MeshError::in_file(file, Problem::WrongCount { what, announced, found })),
    }
}

fn next_line<'a>(
    file: &Path,
    lines: &mut impl Iterator<Item = Words<'a>>,
    expected: &'static str,
) -> Result<Words<'a>, MeshError> {
    lines.next().ok_or_else(|| MeshError::in_file(file, Problem::Ends { expected }))
}
