//! `mesh`: measures meshes and converts them.

use std::collections::HashSet;
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
    let parts: HashSet<usize> = fem_mesh::parts(&mesh).into_iter().collect();
    say!("{:<26}{:>12}", "connected parts", parts.len());
    let coincident = fem_mesh::coincident_nodes(&mesh).map_or("0".to_owned(), |found| {
        let [a, b] = found.first;
        format!("{} (the first: {a} and {b})", found.count)
    });
    say!("{:<26}{coincident:>12}", "coincident nodes");
    // The check refuses a mesh that has some.
    say!("{:<26}{:>12}", "duplicate elements", 0);
    for (name, set) in &mesh.sets {
        say!("set {name:?}: {}", set.counts());
    }
    Ok(())
}

fn convert(from: &Path, to: &Path) -> Result<(), fem_mesh::MeshError> {
    let mesh = fem_mesh::read_tetrahedra(from)?;
    fem_mesh::check(&mesh, from)?;
    fem_mesh::write_tetrahedra(to, &mesh)?;
    if !mesh.sets.is_empty() && fem_mesh::read_tetrahedra(to)?.sets.is_empty() {
        eprintln!(
            "warning: {}: this format has no sets; .msh keeps the {} of {}",
            to.display(),
            mesh.sets.len(),
            from.display()
        );
    }
    say!("{}: {} nodes, {} tetrahedra", to.display(), mesh.vertices.len(), mesh.elements.len());
    Ok(())
}
