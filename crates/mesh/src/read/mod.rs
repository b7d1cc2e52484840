//! Readers of mesh files, by extension. They verify every count that a file announces and every index; [`check`](super::check)
//! tests the mesh itself.

mod gmsh;
mod medit;
mod obj;
mod tetgen;
mod vtu;
mod words;

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use super::{MeshError, Problem, SurfaceMesh, TetrahedralMesh};

/// Extensions of the tetrahedral meshes that can be read and written.
pub(super) const TETRAHEDRAL: &str =
    ".node with .ele (TetGen), .mesh (MEDIT), .msh (Gmsh 4), .vtu (VTK); surfaces are .obj";

/// Extensions of the surfaces that can be read and written.
pub(super) const SURFACES: &str = ".obj (Wavefront)";

/// Reads a tetrahedral mesh: `.node` and `.ele` (TetGen; either name), `.mesh` (MEDIT), `.msh` (Gmsh 4.0 and 4.1), `.vtu`
/// (VTK). Lengths as in the file, m; indices in range; orientation, volumes and unused vertices as the file has them.
pub fn read_tetrahedra(path: &Path) -> Result<TetrahedralMesh, MeshError> {
    match extension(path).as_str() {
        "node" | "ele" => tetgen::read(path),
        "mesh" => medit::read(path, &text(path)?),
        "msh" => gmsh::read(path, &text(path)?),
        "vtu" => vtu::read(path, &bytes(path)?),
        _ => Err(unknown_extension(path, TETRAHEDRAL)),
    }
}

/// Reads a triangle mesh: `.obj` (Wavefront). Polygons become fans of triangles; indices are in range.
pub fn read_surface(path: &Path) -> Result<SurfaceMesh, MeshError> {
    match extension(path).as_str() {
        "obj" => obj::read(path, &text(path)?),
        _ => Err(unknown_extension(path, SURFACES)),
    }
}

/// A path's extension in lower case, without the dot.
pub(super) fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

pub(super) fn unknown_extension(path: &Path, known: &'static str) -> MeshError {
    MeshError::in_file(path, Problem::UnknownExtension { found: format!(".{}", extension(path)), known })
}

fn bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    fs::read(path).map_err(|error| {
        let problem = match error.kind() {
            ErrorKind::NotFound => Problem::Missing,
            _ => Problem::Unreadable { reason: error.to_string() },
        };
        MeshError::in_file(path, problem)
    })
}

/// A file as text without a byte-order mark. Bytes that are not UTF-8 are replaced: names and comments may be in any encoding.
fn text(path: &Path) -> Result<String, MeshError> {
    let bytes = bytes(path)?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    Ok(String::from_utf8_lossy(bytes).into_owned())
}
