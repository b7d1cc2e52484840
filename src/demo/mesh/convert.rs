//! `mesh convert`: from one format to another.

use std::path::Path;

use fem_mesh::{AnyMesh, MeshError};

use super::{write_surface, write_tetrahedra};

/// Reads tetrahedra or triangles and writes them as the extension of `to` says.
pub fn run(from: &Path, to: &Path) -> Result<(), MeshError> {
    let sets = match fem_mesh::read_mesh(from)? {
        AnyMesh::Tetrahedra(mesh) => {
            fem_mesh::check(&mesh, from)?;
            write_tetrahedra(to, &mesh)?;
            mesh.sets.len()
        }
        AnyMesh::Triangles(mesh) => {
            write_surface(to, &mesh)?;
            mesh.sets.len()
        }
    };
    if sets > 0 && !fem_mesh::write::keeps_sets(to) {
        eprintln!("warning: {}: this format has no sets; .msh keeps the {sets} of {}", to.display(), from.display());
    }
    Ok(())
}
