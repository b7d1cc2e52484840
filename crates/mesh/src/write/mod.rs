//! Writers of mesh files, by extension. A file gets its name once it is complete.
//!
//! Numbers in text files have as many digits as an exact round trip needs, at most 17.

mod abaqus;
mod glb;
mod gmsh;
mod medit;
mod obj;
mod ply;
mod pvd;
mod sets;
mod stl;
mod tetgen;
mod vtk;
mod vtu;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};

use flate2::Compression;
use flate2::write::GzEncoder;
use nalgebra::Vector3;

pub use self::glb::{Frame, write_glb};
pub use self::pvd::write_pvd;
pub use self::vtu::{Field, Grid, write_vtu};
use super::read::{MESHES, SURFACES, extension, is_packed, is_surface, unknown_extension};
use super::{AnyMesh, Mesh, MeshError, Problem, SurfaceMesh, TetrahedralMesh};

/// Extensions for tetrahedra, and for triangles beside those of surfaces.
const TETRAHEDRA: [&str; 7] = ["node", "ele", "mesh", "msh", "vtu", "vtk", "inp"];

/// Extensions for quadratic elements.
const QUADRATIC: [&str; 4] = ["inp", "msh", "vtu", "vtk"];

/// Writes tetrahedra or triangles, as [`write_tetrahedra`] and [`write_surface`] do.
pub fn write_mesh(path: &Path, mesh: &AnyMesh) -> Result<(), MeshError> {
    match mesh {
        AnyMesh::Tetrahedra(mesh) => write_tetrahedra(path, mesh),
        AnyMesh::Triangles(mesh) => write_surface(path, mesh),
    }
}

/// Writes a tetrahedral mesh: `.node` and `.ele` (TetGen; both files by either name), `.mesh` (MEDIT), `.msh` (Gmsh 4.1), `.vtu` or
/// `.vtk` (VTK), or `.inp` (Abaqus), each also compressed, with `.gz` after its extension. Reading the file gives the same mesh, bit for
/// bit, and its named sets but for those that [`lost_sets`] tells.
pub fn write_tetrahedra(path: &Path, mesh: &TetrahedralMesh) -> Result<(), MeshError> {
    write_any(path, mesh).unwrap_or_else(|| Err(no_tetrahedra(path)))
}

/// Writes a mesh in a format for tetrahedra and triangles; `None` for another extension.
fn write_any<const N: usize>(path: &Path, mesh: &Mesh<3, N>) -> Option<Result<(), MeshError>> {
    Some(match extension(path).as_str() {
        "node" | "ele" => tetgen::write(path, mesh),
        "mesh" => save_mesh(path, &mut |out| medit::write(out, mesh)),
        "msh" => save_mesh(path, &mut |out| gmsh::write(out, mesh)),
        "vtu" => vtu::write_with_sets(path, mesh),
        "vtk" => save_mesh(path, &mut |out| vtk::write(out, mesh)),
        "inp" => save_mesh(path, &mut |out| abaqus::write(out, mesh)),
        _ => return None,
    })
}

/// Writes quadratic tetrahedra (`N` = 10) or triangles (6), nodes in VTK's order: `.inp` (Abaqus, C3D10), `.msh` (Gmsh 4.1, type 11), `.vtu` or
/// `.vtk` (VTK, type 24), each also compressed. Faces and edges of sets are named by their corners.
pub fn write_quadratic<const N: usize>(path: &Path, mesh: &Mesh<3, N>) -> Result<(), MeshError> {
    let written = if QUADRATIC.contains(&extension(path).as_str()) { write_any(path, mesh) } else { None };
    written.unwrap_or_else(|| {
        let found = format!("a mesh of quadratic elements in a .{} file", extension(path));
        Err(MeshError::in_file(path, Problem::Unsupported { found, instead: "write it as .inp, .msh, .vtu or .vtk" }))
    })
}

/// The error of an extension for which [`write_tetrahedra`] has no format.
fn no_tetrahedra(path: &Path) -> MeshError {
    if !is_surface(path) {
        return unknown_extension(path, MESHES);
    }
    let found = format!("a mesh of tetrahedra in a .{} file, which holds triangles,", extension(path));
    let instead = "write it as .node, .mesh, .msh, .vtu, .vtk or .inp";
    MeshError::in_file(path, Problem::Unsupported { found, instead })
}

/// Writes a triangle mesh: `.obj` (Wavefront), `.ply` (Stanford, binary) or `.stl` (binary), or a file of [`write_tetrahedra`]; each also
/// compressed. Reading the file gives the same mesh, bit for bit, but for `.stl`, which keeps single precision, merges vertices at one
/// place and leaves out unused ones. `.node` is for meshes in the plane z = 0.
pub fn write_surface(path: &Path, mesh: &SurfaceMesh) -> Result<(), MeshError> {
    match extension(path).as_str() {
        "obj" => save_mesh(path, &mut |out| obj::write(out, mesh)),
        "ply" => save_mesh(path, &mut |out| ply::write(out, mesh)),
        "stl" => save_mesh(path, &mut |out| stl::write(out, mesh)),
        _ => write_any(path, mesh).unwrap_or_else(|| Err(unknown_extension(path, SURFACES))),
    }
}

/// Refuses a path to which [`write_tetrahedra`] cannot write: before the work of making a mesh, not after it.
pub fn check_tetrahedra(path: &Path) -> Result<(), MeshError> {
    if TETRAHEDRA.contains(&extension(path).as_str()) { check_place(path) } else { Err(no_tetrahedra(path)) }
}

/// Refuses a path to which [`write_surface`] cannot write.
pub fn check_surface(path: &Path) -> Result<(), MeshError> {
    let is_known = is_surface(path) || TETRAHEDRA.contains(&extension(path).as_str());
    if is_known { check_place(path) } else { Err(unknown_extension(path, SURFACES)) }
}

/// Refuses the path of a folder, and a file in a folder that does not exist.
fn check_place(path: &Path) -> Result<(), MeshError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let reason = match (path.is_dir(), folder.is_dir()) {
        (true, _) => "it is a folder",
        (false, false) => "its folder does not exist",
        (false, true) => return Ok(()),
    };
    Err(MeshError::in_file(path, Problem::Unwritable { reason: reason.to_owned() }))
}

/// The remark on what a file of this extension keeps of the named sets of a mesh; `None` if it keeps all.
pub fn lost_sets<const N: usize>(path: &Path, mesh: &Mesh<3, N>) -> Option<String> {
    let count = mesh.sets.len();
    if count == 0 {
        return None;
    }
    let numbered = |has_edges: bool| {
        let tags = sets::Tags::of(mesh);
        let edges = if has_edges { 0 } else { tags.edges.len() };
        let lost = [(tags.lost, "parts that are in several sets, which keep the first"), (edges, "edges of sets")];
        let lost: Vec<String> =
            lost.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")).collect();
        (!lost.is_empty()).then(|| format!("this format has one number for each part and loses {}", lost.join(" and ")))
    };
    let what = match extension(path).as_str() {
        "mesh" => numbered(true)?,
        "node" | "ele" => numbered(false)?,
        "obj" if mesh.sets.values().all(|set| set.edges.is_empty() && set.points.is_empty()) => return None,
        "obj" => "this format has no sets of edges and points".to_owned(),
        "ply" | "stl" => format!("this format has no sets, and the mesh {count}"),
        "inp" => match mesh.sets.values().map(|set| set.edges.len()).sum() {
            0_usize => return None,
            edges => format!("of {edges} edges of sets this format keeps the nodes"),
        },
        _ => return None,
    };
    Some(format!("{what}; .msh, .vtu and .vtk keep all"))
}

/// Writes the contents of a file, once.
pub type Contents<'a> = &'a mut dyn FnMut(&mut dyn Write) -> io::Result<()>;

/// Writes a temporary file in the same folder and renames it, so that no incomplete file has the name. A link stays a link, to
/// the new file; a device or pipe is written directly.
pub fn save(path: &Path, write: Contents) -> Result<(), MeshError> {
    let unwritable = |error: io::Error| MeshError::in_file(path, Problem::Unwritable { reason: error.to_string() });
    if fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir()) {
        return write_all(path, write).map(drop).map_err(unwritable);
    }
    let target = fs::canonicalize(path).unwrap_or(path.to_owned());
    let unfinished = unfinished_name(&target);
    let result =
        write_all(&unfinished, write).and_then(|file| file.sync_all()).and_then(|()| fs::rename(&unfinished, target));
    result.map_err(|error| {
        // The temporary file may not exist; the first error is reported.
        let _ = fs::remove_file(&unfinished);
        unwritable(error)
    })
}

/// [`save`] of contents that are known.
pub fn save_bytes(path: &Path, bytes: &[u8]) -> Result<(), MeshError> {
    save(path, &mut |out| out.write_all(bytes))
}

/// [`save`] of a mesh file, which is compressed if its name ends in `.gz`.
fn save_mesh(path: &Path, write: Contents) -> Result<(), MeshError> {
    if !is_packed(path) {
        return save(path, write);
    }
    save(path, &mut |out| {
        let mut packed = GzEncoder::new(out, Compression::default());
        write(&mut packed)?;
        packed.finish().map(drop)
    })
}

fn write_all(path: &Path, write: Contents) -> io::Result<File> {
    let mut out = BufWriter::new(File::create(path)?);
    write(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)
}

/// A name that differs between processes and between calls, so that no two writers share a file.
fn unfinished_name(path: &Path) -> PathBuf {
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let call = CALLS.fetch_add(1, Ordering::Relaxed);
    path.with_file_name(format!(".{name}.{}-{call}.part", process::id()))
}

/// `x y z` with the digits of an exact round trip.
fn place(x: &Vector3<f64>) -> String {
    format!("{:?} {:?} {:?}", x[0], x[1], x[2])
}

/// `x y` with the digits of an exact round trip.
fn place_in_plane(x: &Vector3<f64>) -> String {
    format!("{:?} {:?}", x[0], x[1])
}

/// A name with the special characters of an XML attribute escaped.
fn escape(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
