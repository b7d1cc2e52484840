//! `mesh`: measures meshes and converts them.

use std::path::Path;

use super::cli::MeshAction;
use super::end::End;

/// Runs a subcommand of `mesh`.
pub fn run(action: &MeshAction) -> Result<(), End> {
    match action {
        MeshAction::Info { file } => info(file),
        MeshAction::Convert { from, to } => convert(from, to),
    }
    .map_err(End::unusable)
}

fn info(file: &Path) -> Result<(), fem_mesh::MeshError> {
    let mesh = fem_mesh::read_tetrahedra(file)?;
    fem_mesh::check(&mesh, file)?;
    say!("{}", fem_mesh::quality(&mesh).to_string().trim_end());
    Ok(())
}

fn convert(from: &Path, to: &Path) -> Result<(), fem_mesh::MeshError> {
    let mesh = fem_mesh::read_tetrahedra(from)?;
    fem_mesh::check(&mesh, from)?;
    fem_mesh::write_tetrahedra(to, &mesh)?;
    say!("{}: {} nodes, {} tetrahedra", to.display(), mesh.vertices.len(), mesh.elements.len());
    Ok(())
}
