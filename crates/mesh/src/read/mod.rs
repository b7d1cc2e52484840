//! Readers of mesh files, by extension. They verify every count that a file announces and every index; [`check`](super::check)
//! tests the mesh itself.

mod cells;
mod content;
mod gmsh;
mod medit;
mod obj;
mod ply;
mod points;
mod stl;
mod tetgen;
mod vtk;
mod vtu;
mod words;

use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;

pub use self::content::AnyMesh;
use self::content::Content;
pub use self::points::{Points, read_points};
use super::{MeshError, Problem, SurfaceMesh, TetrahedralMesh};

/// Largest ratio of the sizes of a file unpacked and packed. Meshes have less than 10; gzip can reach 1032.
const MOST_UNPACKED: u64 = 200;

/// Extensions of the files of tetrahedra or triangles.
pub(super) const MESHES: &str = ".node with .ele (TetGen, Triangle), .mesh (MEDIT), .msh (Gmsh), .vtu or .vtk (VTK), each also as .gz; surfaces are .obj, .ply or .stl";

/// Extensions of the files of triangles.
pub(super) const SURFACES: &str = ".obj (Wavefront), .ply (Stanford), .stl, or those of meshes: .mesh (MEDIT), .msh (Gmsh), .vtu or .vtk (VTK), .node with .ele (Triangle); each also as .gz";

/// Reads a mesh of the kind that its file holds: tetrahedra if there are any, as [`read_tetrahedra`] does, and triangles otherwise, as
/// [`read_surface`] does.
pub fn read_mesh(path: &Path) -> Result<AnyMesh, MeshError> {
    if is_surface(path) { polygons(path).map(AnyMesh::Triangles) } else { content(path, MESHES)?.mesh(path) }
}

/// Reads a tetrahedral mesh: `.node` and `.ele` (TetGen; either name), `.mesh` (MEDIT), `.msh` (Gmsh 2 and 4), `.vtu` and
/// `.vtk` (VTK), each also compressed, with `.gz` after its extension. Lengths as in the file, m; indices in range; orientation,
/// volumes and unused vertices as the file has them. Physical groups of Gmsh become named sets.
pub fn read_tetrahedra(path: &Path) -> Result<TetrahedralMesh, MeshError> {
    content(path, MESHES)?.tetrahedra(path)
}

/// Reads a triangle mesh: `.obj` (Wavefront), `.ply` (Stanford) or `.stl`, text and binary, or the triangles of a file of
/// [`read_tetrahedra`] that has no tetrahedra; each also compressed. Polygons become fans of triangles; indices are in range. Equal corners
/// of an `.stl` are one vertex. Plane meshes have z = 0.
pub fn read_surface(path: &Path) -> Result<SurfaceMesh, MeshError> {
    if is_surface(path) { polygons(path) } else { content(path, SURFACES)?.triangles(path) }
}

/// The simplices of a file; `known` are the extensions of its message.
fn content(path: &Path, known: &'static str) -> Result<Content, MeshError> {
    match extension(path).as_str() {
        "node" | "ele" => tetgen::read(path),
        "mesh" => medit::read(path, &text(path)?),
        "msh" => gmsh::read(path, bytes(path)?),
        "vtu" => vtu::read(path, &bytes(path)?),
        "vtk" => vtk::read(path, &bytes(path)?),
        _ => Err(unknown_extension(path, known)),
    }
}

fn polygons(path: &Path) -> Result<SurfaceMesh, MeshError> {
    match extension(path).as_str() {
        "obj" => obj::read(path, &text(path)?),
        "ply" => ply::read(path, &bytes(path)?),
        _ => stl::read(path, bytes(path)?),
    }
}

/// Returns true if a path has the extension of a file that holds surfaces alone.
pub fn is_surface(path: &Path) -> bool {
    ["obj", "ply", "stl"].contains(&extension(path).as_str())
}

/// A path's extension in lower case, without the dot and without a `.gz` after it.
pub(super) fn extension(path: &Path) -> String {
    let plain = if is_packed(path) { path.with_extension("") } else { path.to_owned() };
    plain.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// Returns true if a path ends in `.gz`.
pub(super) fn is_packed(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"))
}

/// The path with another extension before its `.gz`, if it has one.
pub(super) fn with_extension(path: &Path, extension: &str) -> PathBuf {
    match path.extension() {
        Some(packed) if is_packed(path) => {
            let packed = packed.to_string_lossy();
            path.with_extension("").with_extension(format!("{extension}.{packed}"))
        }
        _ => path.with_extension(extension),
    }
}

pub(super) fn unknown_extension(path: &Path, known: &'static str) -> MeshError {
    MeshError::in_file(path, Problem::UnknownExtension { found: format!(".{}", extension(path)), known })
}

/// The content of a file, unpacked.
fn bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    let bytes = fs::read(path).map_err(|error| {
        let problem = match error.kind() {
            ErrorKind::NotFound => Problem::Missing,
            _ => Problem::Unreadable { reason: error.to_string() },
        };
        MeshError::in_file(path, problem)
    })?;
    if !is_packed(path) {
        return Ok(bytes);
    }
    let mut unpacked = Vec::new();
    let limit = MOST_UNPACKED.saturating_mul(bytes.len() as u64);
    let unpacking = MultiGzDecoder::new(&bytes[..]).take(limit).read_to_end(&mut unpacked);
    let damaged = |reason: String| MeshError::in_file(path, Problem::Malformed { reason });
    match unpacking {
        Ok(length) if length as u64 == limit => {
            Err(damaged("it unpacks to no mesh, but to far too many bytes".to_owned()))
        }
        Ok(_) => {
            unpacked.shrink_to_fit();
            Ok(unpacked)
        }
        Err(error) => Err(damaged(format!("it is no complete gzip file ({error})"))),
    }
}

/// A file as text without a byte-order mark. Bytes that are not UTF-8 become question marks: names and comments may be in any encoding.
fn text(path: &Path) -> Result<String, MeshError> {
    let mut bytes = bytes(path)?;
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    Ok(readable(bytes))
}

/// The bytes as text, in their place in memory, with question marks for those that are not UTF-8.
fn readable(mut bytes: Vec<u8>) -> String {
    let mut checked = 0;
    while let Err(error) = str::from_utf8(&bytes[checked..]) {
        let start = checked + error.valid_up_to();
        checked = error.error_len().map_or(bytes.len(), |length| start + length);
        bytes[start..checked].fill(b'?');
    }
    String::from_utf8(bytes).unwrap_or_default()
}
