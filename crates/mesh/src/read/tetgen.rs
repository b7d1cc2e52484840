//! Pairs of text files of TetGen (tetrahedra) and of Triangle (triangles in the plane). Sources: H. Si, TetGen manual 1.6, section 5.2.1
//! (.node), 5.2.4 (.ele) and 5.2.5 (.face); J. R. Shewchuk, Triangle's page on .node and .ele files.

use std::path::{Path, PathBuf};

use nalgebra::Vector3;

use super::content::{Content, Entry};
use super::words::{Words, rows};
use super::{extension, text, with_extension};
use crate::{MeshError, Problem};

/// The nodes of a file.
pub(super) struct Nodes {
    /// z is 0 in files of the plane.
    pub places: Vec<Vector3<f64>>,
    /// Number of the first, 0 or 1.
    first: i64,
    pub dimension: usize,
    /// The boundary marker of each; empty if the file has none.
    markers: Vec<i32>,
}

/// Reads `path`, its partner of the same stem, and the `.face` file beside them if there is one. All numbers count from that of the first
/// node, 0 or 1. Regions, which are the first attribute of the elements, and boundary markers become sets.
pub(super) fn read(path: &Path) -> Result<Content, MeshError> {
    let [node_file, ele_file] = pair(path);
    let partner = if node_file == path { &ele_file } else { &node_file };
    if !partner.exists() {
        return Err(MeshError::in_file(path, Problem::PartnerMissing { partner: partner.clone() }));
    }
    let mut content = Content::default();
    let nodes = nodes(&node_file, &text(&node_file)?, &mut content)?;
    if nodes.dimension == 2 {
        let words = ["triangles", "run triangle without -o2"];
        elements(&ele_file, &nodes, words, &mut content, |content, corners: [_; 3]| content.polygon(&corners))?;
    } else {
        let words = ["tetrahedra", "run tetgen without -o2"];
        elements(&ele_file, &nodes, words, &mut content, Content::tetrahedron)?;
        let face_file = with_extension(&node_file, "face");
        if face_file.exists() {
            faces(&face_file, &nodes, &mut content)?;
        }
    }
    (content.vertices, content.node_tags) = (nodes.places, nodes.markers);
    Ok(content)
}

/// The `.node` and the `.ele` file of a mesh by the name of either.
pub(crate) fn pair(path: &Path) -> [PathBuf; 2] {
    match extension(path).as_str() {
        "node" => [path.to_owned(), with_extension(path, "ele")],
        _ => [with_extension(path, "node"), path.to_owned()],
    }
}

/// The counts of a header, of which those that `default` has may be missing.
fn header<'a, const N: usize>(
    file: &Path,
    lines: &mut impl Iterator<Item = Words<'a>>,
    what: &'static str,
    default: [Option<usize>; N],
) -> Result<(Words<'a>, [usize; N]), MeshError> {
    let mut header = lines.next().ok_or_else(|| MeshError::in_file(file, Problem::Empty { what }))?;
    let names = [
        "the number of entries",
        "the dimension or number of nodes",
        "the number of attributes",
        "the number of markers",
    ];
    let mut counts = [0; N];
    for (i, count) in counts.iter_mut().enumerate() {
        *count = match default[i].filter(|_| header.peek().is_none()) {
            Some(default) => default,
            None => header.amount(names[i.min(3)])?,
        };
    }
    header.end("the counts of the file")?;
    Ok((header, counts))
}

/// `<nodes> <dimension> <attributes> <markers>`, then `<number> <x> <y> <z> …` for each, without z in two dimensions.
pub(super) fn nodes(file: &Path, text: &str, content: &mut Content) -> Result<Nodes, MeshError> {
    let mut lines = Words::of_lines(file, text);
    let default = [None, Some(3), Some(0), Some(0)];
    let (header, [announced, dimension, attributes, has_markers]) = header(file, &mut lines, "nodes", default)?;
    if ![2, 3].contains(&dimension) {
        let found = format!("the dimension {dimension}");
        return Err(
            header.error(Problem::Unsupported { found, instead: "give a mesh in the plane (2) or in space (3)" })
        );
    }
    if attributes > 0 {
        content.notes.unread("attributes of nodes");
    }
    let (mut first, mut markers) = (0, Vec::new());
    let places = rows(file, lines, "nodes", announced, |row, line| {
        let number = line.integer("the number of a node")?;
        if row == 0 && (number == 0 || number == 1) {
            first = number;
        }
        consecutive(line, number, first, row)?;
        let place = if dimension == 2 { line.place_in_plane()? } else { line.place()? };
        for _ in 0..attributes {
            line.real("an attribute of a node")?;
        }
        if has_markers > 0 {
            markers.push(line.tag("the boundary marker of a node")?);
        }
        line.end("the last entry of the node")?;
        Ok(place)
    })?;
    Ok(Nodes { places, first, dimension, markers })
}

/// `<elements> <nodes of each> <attributes>`, then `<number> <a> <b> <c> … <attributes>` for each. The words are the elements' name
/// and the remedy if they have more nodes than corners; `add` takes the corners.
fn elements<const N: usize>(
    file: &Path,
    nodes: &Nodes,
    [what, instead]: [&'static str; 2],
    content: &mut Content,
    add: impl Fn(&mut Content, [usize; N]) -> Entry,
) -> Result<(), MeshError> {
    let text = text(file)?;
    content.name_tags_from(&text);
    let mut lines = Words::of_lines(file, &text);
    let (header, [announced, corners, attributes]) = header(file, &mut lines, what, [None, Some(N), Some(0)])?;
    if corners != N {
        let found = format!("a mesh of elements with {corners} nodes, and nodes of dimension {},", N - 1);
        return Err(header.error(Problem::Unsupported { found, instead }));
    }
    rows(file, lines, what, announced, |row, line| {
        let number = line.integer("the number of an element")?;
        consecutive(line, number, nodes.first, row)?;
        let (corners, mut region) = (corners_of(line, nodes)?, 0);
        for attribute in 0..attributes {
            let value = line.real("an attribute of an element")?;
            if attribute == 0 && value.fract() == 0.0 {
                region = value as i64;
            } else {
                content.notes.unread("attributes of elements that are no integers or not the first");
            }
        }
        let entry = add(content, corners);
        content.tag(region, entry);
        line.end("the last entry of the element")
    })?;
    Ok(())
}

/// `<faces> <markers>`, then `<number> <a> <b> <c> <marker> …` for each; the elements beside a face may follow.
fn faces(file: &Path, nodes: &Nodes, content: &mut Content) -> Result<(), MeshError> {
    let text = text(file)?;
    let mut lines = Words::of_lines(file, &text);
    let (_, [announced, has_markers]) = header(file, &mut lines, "faces", [None, Some(0)])?;
    rows(file, lines, "faces", announced, |_, line| {
        line.integer("the number of a face")?;
        let corners = corners_of(line, nodes)?;
        if has_markers == 0 {
            return Ok(());
        }
        let marker = line.tag("the boundary marker of a face")?;
        let index = content.triangles.len();
        // TetGen marks faces inside a body by -1 where it does not leave them out.
        if marker > 0
            && let Some(parts) = content.tagged(marker.into())
        {
            parts.triangles.push(index);
            content.triangles.push(corners);
        }
        Ok(())
    })?;
    Ok(())
}

fn corners_of<const N: usize>(line: &mut Words, nodes: &Nodes) -> Result<[usize; N], MeshError> {
    let mut corners = [0; N];
    for vertex in &mut corners {
        *vertex = line.index(nodes.first, nodes.places.len())?;
    }
    Ok(corners)
}

fn consecutive(line: &Words, found: i64, first: i64, row: usize) -> Result<(), MeshError> {
    let expected = first + row as i64;
    if found == expected { Ok(()) } else { Err(line.error(Problem::NotConsecutive { expected, found })) }
}
