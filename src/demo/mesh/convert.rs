//! `mesh convert`: from one format to another.

use std::path::Path;

use fem_mesh::MeshError;

use super::{write_surface, write_tetrahedra};

/// Reads a mesh or a surface and writes it as the extension of `to` says.
pub fn run(from: &Path, to: &Path) -> Result<(), MeshError> {
    if fem_mesh::is_surface(from) { write_surface(to, &fem_mesh::read_surface(from)?) } else { convert(from, to) }
}

fn convert(from: &Path, to: &Path) -> Result<(), MeshError> {
    let mesh = fem_mesh::read_tetrahedra(from)?;
    fem_mesh::check(&mesh, from)?;
    write_tetrahedra(to, &mesh)?;
    if !mesh.sets.is_empty() && fem_mesh::read_tetrahedra(to)?.sets.is_empty() {
        eprintln!(
            "warning: {}: this format has no sets; .msh keeps the {} of {}",
            to.display(),
            mesh.sets.len(),
            from.display()
        );
    }
    Ok(())
}
