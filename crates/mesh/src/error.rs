//! The error of reading, checking, building and writing meshes.

use std::fmt;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A problem with a mesh, its location and the remedy, in one message such as
/// `bunny.ele, line 7: vertex 400 does not exist, …`.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}{place}: {problem}", file.display())]
pub struct MeshError {
    /// The file, or the name of another source, such as `box`.
    pub file: PathBuf,
    /// Place of the problem in the file.
    pub place: Place,
    /// The problem; its text names the element or vertex, and the remedy. Boxed to keep results small.
    pub problem: Box<Problem>,
}

impl MeshError {
    /// A problem of a file as a whole.
    pub fn in_file(file: &Path, problem: Problem) -> Self {
        Self { file: file.to_owned(), place: Place::File, problem: Box::new(problem) }
    }

    /// A problem of one line, counted from 1.
    pub fn in_line(file: &Path, line: usize, problem: Problem) -> Self {
        Self { file: file.to_owned(), place: Place::Line(line), problem: Box::new(problem) }
    }

    /// A problem of binary data, at a byte counted from 0.
    pub fn in_byte(file: &Path, byte: usize, problem: Problem) -> Self {
        Self { file: file.to_owned(), place: Place::Byte(byte), problem: Box::new(problem) }
    }
}

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line of text, counted from 1.
    Line(usize),
    /// A byte of binary data, counted from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(line) => write!(f, ", line {line}"),
            Self::Byte(byte) => write!(f, ", byte {byte}"),
        }
    }
}

/// The problems that a mesh can have. Messages count vertices and elements from 0, as in memory, unless they tell the file's own
/// count.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)] // the messages are the documentation
pub enum Problem {
    #[error("there is no such file; check the path, which counts from the current folder unless it is absolute")]
    Missing,
    #[error("the mesh needs `{}` as well, and it is not there; put the .node and the .ele file of a mesh side by side under one name", partner.display())]
    PartnerMissing { partner: PathBuf },
    #[error("cannot be read ({reason}); check that it is a file and that you may read it")]
    Unreadable { reason: String },
    #[error(
        "cannot be written ({reason}); check that the folder exists, that you may write there, and that the disk is not full"
    )]
    Unwritable { reason: String },
    #[error("the extension `{found}` is unknown here; use one of {known}")]
    UnknownExtension { found: String, known: &'static str },
    #[error("{} is not supported; {instead}", short(.found, 240))]
    Unsupported { found: String, instead: &'static str },
    #[error("{}; export the mesh again", short(.reason, 240))]
    Malformed { reason: String },
    #[error("`{}` stands after {last}, where the row should end; correct the row, or what the file announces of it", short(.word, 60))]
    RowTooLong { word: String, last: &'static str },
    #[error(
        "a row of {what} has {expected} entries, and here are {found}; correct the row or the dimension of the file"
    )]
    BrokenRow { what: &'static str, expected: usize, found: usize },
    #[error("{expected} is missing here; complete the entry or correct the counts above it")]
    Ends { expected: &'static str },
    #[error("`{}` is not {expected}; correct it", short(.word, 60))]
    NotA { word: String, expected: &'static str },
    #[error("announces {announced} {what} and holds {found}; correct the count or complete the file")]
    WrongCount { what: &'static str, announced: usize, found: usize },
    #[error("the coordinate `{}` is not finite; give the vertex a finite position or remove it", short(.word, 60))]
    NotFinite { word: String },
    #[error("vertex {vertex} has a coordinate that is not finite; give it a finite position or remove it")]
    VertexNotFinite { vertex: usize },
    #[error("vertex {index} does not exist, the file's vertices are {first} to {last}; correct the index")]
    OutOfRange { index: i64, first: i64, last: i64 },
    #[error("there are no vertices that the index {index} could mean; add them or correct the file's counts")]
    NoVertices { index: i64 },
    #[error("element {element} names vertex {vertex}, and there are only 0 to {} (all counted from 0); correct the index", *count as i128 - 1)]
    ElementOutOfRange { element: usize, vertex: i128, count: usize },
    #[error("the number {found} stands in place of {expected}; number the entries one after the other, from 0 or 1")]
    NotConsecutive { expected: i64, found: i64 },
    #[error("the tag {tag} is given to two nodes; give each node its own")]
    RepeatedTag { tag: i64 },
    #[error("the file has no node with the tag {tag}; correct it or export the mesh with all of its nodes")]
    UnknownTag { tag: i64 },
    #[error(
        "element {element} (counted from 0) has vertex {vertex} twice; give it different vertices, or leave such elements out by `mesh convert --clean`"
    )]
    RepeatedVertex { element: usize, vertex: usize },
    #[error(
        "element {element} (counted from 0) has the negative volume {volume:e} m³, the first of {count} such elements; turn them by `mesh convert --orient`"
    )]
    Inverted { element: usize, volume: f64, count: usize },
    #[error(
        "element {element} (counted from 0) has no volume ({volume:e} m³ within rounding); move its vertices apart, or leave such elements out by `mesh convert --clean`"
    )]
    Flat { element: usize, volume: f64 },
    #[error(
        "vertex {vertex} (counted from 0) has z = {z} m; a flat body lies in the plane z = 0, move it there (Gmsh: Translate {{0, 0, {}}} {{ … }})",
        -z
    )]
    OutOfPlane { vertex: usize, z: f64 },
    #[error(
        "triangle {element} (counted from 0) is clockwise, with the area {area:e} m², the first of {count} such triangles; turn them by `mesh convert --orient`"
    )]
    Clockwise { element: usize, area: f64, count: usize },
    #[error(
        "triangle {element} (counted from 0) has no area ({area:e} m² within rounding); move its vertices apart, or leave such triangles out by `mesh convert --clean`"
    )]
    NoArea { element: usize, area: f64 },
    #[error("element {element} (counted from 0) is too large to compute its volume; scale the mesh to metres")]
    Huge { element: usize },
    #[error(
        "element {element} (counted from 0) has the same vertices as element {original}, and {count} elements repeat an earlier one; leave them out by `mesh convert --clean`"
    )]
    DuplicateElement { element: usize, original: usize, count: usize },
    #[error("vertex {vertex} (counted from 0) belongs to no element; remove it, or add the element that it belongs to")]
    Unreferenced { vertex: usize },
    #[error("the set `{set}` has {part} (counted from 0), which is no part of a tetrahedron; remove it from the set")]
    StrayPart { set: String, part: String },
    #[error("the mesh has no {what}; give one that has some")]
    Empty { what: &'static str },
    #[error(
        "the size {size} m along {axis} times {cells_per_unit} cells per metre is not a whole number of cells, at least 1; change either"
    )]
    BoxCells { axis: char, size: f64, cells_per_unit: usize },
    #[error(
        "the {whole} would have {count:e} {elements} ({cells} cells), and {most} is the most; lower cells_per_unit or its size"
    )]
    GridTooFine { whole: &'static str, cells: String, count: f64, elements: &'static str, most: usize },
    #[error("refined {times} times the mesh would have {elements:e} elements, and {most} is the most; refine it less")]
    RefinedTooFine { times: u32, elements: f64, most: usize },
    #[error(
        "the field `{name}` has {found} numbers, and {expected} are needed ({components} for each {per}); pass one entry for each {per}"
    )]
    FieldSize { name: String, found: usize, expected: usize, components: usize, per: &'static str },
    #[error(transparent)]
    Stuffing(StuffingError),
    #[error("frame {frame} (counted from 0) {reason}; pass frames of one mesh in the order of their times")]
    Frame { frame: usize, reason: String },
}

/// Reason why a surface has no tetrahedra inside.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)] // the messages are the documentation of the fields
pub enum StuffingError {
    /// A vertex is NaN or infinite.
    #[error(
        "vertex {vertex} (counted from 0) has a coordinate that is not finite; give it a finite position or remove it"
    )]
    NotFinite { vertex: usize },
    /// The edge length is no length.
    #[error("an edge of {edge} m; give a length above 0")]
    Edge { edge: f64 },
    /// Too many tetrahedra.
    #[error(
        "with edges of {edge} m the box around the surface would have {count:.1e} tetrahedra, and {most:.0e} is the most; take longer edges"
    )]
    TooFine { edge: f64, count: f64, most: f64 },
    /// A triangle crosses the boundary of a cage that contains all tetrahedra which it touches: its coordinates are too large for the edge.
    #[error(
        "triangle {triangle} (counted from 0) is not enclosed by tetrahedra with edges of {edge} m; take longer edges, or move the surface to the origin"
    )]
    NotEnclosed { triangle: usize, edge: f64 },
    /// The lattice has no node inside the surface.
    #[error(
        "with edges of {edge} m no point of the lattice lies inside the surface; take shorter edges (the surface measures {} × {} × {} m), or close it", size[0], size[1], size[2]
    )]
    Empty { edge: f64, size: [f64; 3] },
}

/// The first characters of a file's content, which may be long or binary, in one line that a terminal can show.
fn short(text: &str, most: usize) -> String {
    let shown = text.chars().take(most).map(|c| if c.is_control() { '\u{fffd}' } else { c });
    let more = if text.chars().nth(most).is_some() { "…" } else { "" };
    shown.collect::<String>() + more
}
