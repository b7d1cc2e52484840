//! `mesh`: measures, converts and makes meshes.

mod convert;
mod delaunay;
mod from_picture;
mod from_surface;
mod improve;
mod info;
mod shapes;

use std::path::{Path, PathBuf};

use clap::Subcommand;
use fem_mesh::{MeshError, SurfaceMesh, TetrahedralMesh};

use crate::end::End;

/// The subcommands of `mesh`.
#[derive(Debug, Subcommand)]
pub enum MeshAction {
    /// Counts, volume, quality and histograms of a mesh (.node, .mesh, .msh, .vtu, .vtk, .inp), or of a surface (.obj, .ply, .stl, or a mesh of triangles)
    Info(info::Arguments),
    /// Reads tetrahedra or triangles and writes them in another format; repairs them if asked to
    Convert(convert::Arguments),
    /// Delaunay triangles of points in the plane, or tetrahedra of points in space (.csv, .node)
    Delaunay { points: PathBuf, out: PathBuf },
    /// Triangles inside the opaque or dark region of a picture (PNG, JPEG), with its holes
    FromPicture(from_picture::Arguments),
    /// Tetrahedra inside a surface (.obj, .ply, .stl), which may have holes and cross itself
    FromSurface(from_surface::Arguments),
    /// Better elements for the same body: optimal Delaunay triangulation and flips; the worst element is never worse than before
    Improve(improve::Arguments),
}

impl MeshAction {
    /// Runs the subcommand.
    pub fn run(&self) -> Result<(), End> {
        match self {
            Self::Info(arguments) => info::run(arguments),
            Self::Convert(arguments) => convert::run(arguments).map_err(End::unusable),
            Self::Delaunay { points, out } => delaunay::run(points, out),
            Self::FromPicture(arguments) => from_picture::run(arguments),
            Self::FromSurface(arguments) => from_surface::run(arguments).map_err(End::unusable),
            Self::Improve(arguments) => improve::run(arguments),
        }
    }
}

/// Prints what was left out of a file or changed.
fn tell(file: &Path, notes: &[String]) {
    notes.iter().for_each(|note| eprintln!("note: {}: {note}", file.display()));
}

fn write_tetrahedra(to: &Path, mesh: &TetrahedralMesh) -> Result<(), MeshError> {
    fem_mesh::write_tetrahedra(to, mesh)?;
    say!("{}: {} nodes, {} tetrahedra", to.display(), mesh.vertices.len(), mesh.elements.len());
    Ok(())
}

fn write_surface(to: &Path, mesh: &SurfaceMesh) -> Result<(), MeshError> {
    fem_mesh::write_surface(to, mesh)?;
    say!("{}: {} nodes, {} triangles", to.display(), mesh.vertices.len(), mesh.elements.len());
    Ok(())
}
