//! Pairs of text files, counted from 0: TetGen's for tetrahedra, Triangle's for triangles in the plane. Sources: H. Si, TetGen manual
//! 1.6, section 5.2; J. R. Shewchuk, Triangle's page on .node and .ele files.

use std::path::Path;

use super::{place, place_in_plane, save_mesh};
use crate::read::{extension, with_extension};
use crate::{Mesh, MeshError, Problem, SurfaceMesh, TetrahedralMesh};

/// Writes `path` and its partner of the same stem.
pub(super) fn write(path: &Path, mesh: &TetrahedralMesh) -> Result<(), MeshError> {
    write_pair(path, mesh, 3)
}

/// Writes a mesh in the plane z = 0 to `path` and its partner of the same stem, with two coordinates. Other surfaces are refused.
pub(super) fn write_plane(path: &Path, mesh: &SurfaceMesh) -> Result<(), MeshError> {
    if mesh.vertices.iter().any(|x| x.z != 0.0) {
        let found = "a surface outside of the plane z = 0 in a .node file".to_owned();
        let instead = "write it as .obj, .ply, .stl, .mesh, .msh, .vtu or .vtk";
        return Err(MeshError::in_file(path, Problem::Unsupported { found, instead }));
    }
    write_pair(path, mesh, 2)
}

fn write_pair<const N: usize>(path: &Path, mesh: &Mesh<3, N>, dimension: usize) -> Result<(), MeshError> {
    let (node_file, ele_file) = match extension(path).as_str() {
        "node" => (path.to_owned(), with_extension(path, "ele")),
        _ => (with_extension(path, "node"), path.to_owned()),
    };
    save_mesh(&ele_file, &mut |out| {
        writeln!(out, "{} {N} 0", mesh.elements.len())?;
        for (i, element) in mesh.elements.iter().enumerate() {
            write!(out, "{i}")?;
            element.iter().try_for_each(|vertex| write!(out, " {vertex}"))?;
            writeln!(out)?;
        }
        Ok(())
    })?;
    save_mesh(&node_file, &mut |out| {
        writeln!(out, "{} {dimension} 0 0", mesh.vertices.len())?;
        for (i, x) in mesh.vertices.iter().enumerate() {
            writeln!(out, "{i} {}", if dimension == 2 { place_in_plane(x) } else { place(x) })?;
        }
        Ok(())
    })
}
