//! Readers of mesh files, by extension. They verify every count that a file announces and every index; [`check`](super::check)
//! tests the mesh itself.

mod abaqus;
mod cells;
mod content;
mod gmsh;
mod medit;
mod notes;
mod obj;
mod ply;
mod points;
mod program;
mod stl;
mod tetgen;
mod vtk;
mod vtu;
mod words;

use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;

pub(super) use self::abaqus::FACES as ABAQUS_FACES;
pub(super) use self::cells::SET;
use self::content::Content;
pub use self::content::{AnyMesh, MeshFile};
pub use self::points::{Points, read_points};
pub(super) use self::tetgen::pair;
use super::{MeshError, Problem, SurfaceMesh, TetrahedralMesh};

/// Largest ratio of the sizes of a file unpacked and packed. Meshes have less than 10; gzip can reach 1032.
const MOST_UNPACKED: u64 = 200;

/// Extensions of the files of tetrahedra or triangles.
pub(super) const MESHES: &str = ".node with .ele (TetGen, Triangle), .mesh (MEDIT), .msh (Gmsh), .vtu or .vtk (VTK), .inp (Abaqus), each also as .gz; surfaces are .obj, .ply or .stl";

/// Extensions of all files of meshes.
pub(super) const SURFACES: &str = ".obj (Wavefront), .ply (Stanford), .stl, or those of meshes: .mesh (MEDIT), .msh (Gmsh), .vtu or .vtk (VTK), .inp (Abaqus), .node with .ele (TetGen, Triangle); each also as .gz";

/// Reads a mesh file and tells what it leaves out: `.node` and `.ele` (TetGen, Triangle; either name, with the `.face` file beside them),
/// `.mesh` (MEDIT), `.msh` (Gmsh 1, 2 and 4), `.vtu` and `.vtk` (VTK), `.inp` (Abaqus), or a surface: `.obj` (Wavefront), `.ply`
/// (Stanford) or `.stl`, text and binary. Each also compressed, with `.gz` after its extension.
///
/// Tetrahedra if there are any, and triangles otherwise, polygons as fans; z is 0 in files of the plane. Lengths as in the file, m; indices
/// in range. Nodes of no element are left out. A mesh whose elements all have a negative volume, or area in the plane z = 0, is turned.
/// Surfaces lose triangles without an area and those that repeat another. Groups, tags and references become named sets.
pub fn read_file(path: &Path) -> Result<MeshFile, MeshError> {
    let read: fn(&Path, Vec<u8>) -> Result<Content, MeshError> = match extension(path).as_str() {
        "node" | "ele" => |path, bytes| {
            drop(bytes);
            tetgen::read(path)
        },
        "mesh" => |path, bytes| medit::read(path, &readable(bytes)),
        "msh" => gmsh::read,
        "vtu" => |path, bytes| vtu::read(path, &bytes),
        "vtk" => |path, bytes| vtk::read(path, &bytes),
        "inp" => |path, bytes| abaqus::read(path, readable(bytes)),
        "obj" => |path, bytes| obj::read(path, &readable(bytes)),
        "ply" => |path, bytes| ply::read(path, &bytes),
        "stl" => stl::read,
        _ => return Err(unknown_extension(path, SURFACES)),
    };
    let bytes = bytes(path)?;
    let program = program::of(&bytes);
    read(path, bytes)?.finish(path, program)
}

/// The mesh of [`read_file`].
pub fn read_mesh(path: &Path) -> Result<AnyMesh, MeshError> {
    Ok(read_file(path)?.mesh)
}

/// The mesh of [`read_file`], which has to consist of tetrahedra.
pub fn read_tetrahedra(path: &Path) -> Result<TetrahedralMesh, MeshError> {
    if is_surface(path) { Err(unknown_extension(path, MESHES)) } else { read_file(path)?.tetrahedra(path) }
}

/// The mesh of [`read_file`], which has to consist of triangles.
pub fn read_surface(path: &Path) -> Result<SurfaceMesh, MeshError> {
    read_file(path)?.triangles(path)
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

/// The content of a file, unpacked and without a byte-order mark.
fn bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    let mut bytes = unpacked(path)?;
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    Ok(bytes)
}

fn unpacked(path: &Path) -> Result<Vec<u8>, MeshError> {
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

/// A file as text.
fn text(path: &Path) -> Result<String, MeshError> {
    bytes(path).map(readable)
}

/// The bytes as text, in their place in memory, with question marks for those that are not UTF-8: names and comments may be in any
/// encoding.
fn readable(mut bytes: Vec<u8>) -> String {
    let mut checked = 0;
    while let Err(error) = str::from_utf8(&bytes[checked..]) {
        let start = checked + error.valid_up_to();
        checked = error.error_len().map_or(bytes.len(), |length| start + length);
        bytes[start..checked].fill(b'?');
    }
    String::from_utf8(bytes).unwrap_or_default()
}
