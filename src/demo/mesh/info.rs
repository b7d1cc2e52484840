//! `mesh info`: counts, sizes and shapes.

use std::collections::HashSet;
use std::path::Path;

use fem_mesh::{AnyMesh, MeshError, SurfaceMesh, TetrahedralMesh};

/// Prints the measures of a mesh or of a surface.
pub fn run(file: &Path) -> Result<(), MeshError> {
    match fem_mesh::read_mesh(file)? {
        AnyMesh::Tetrahedra(mesh) => info(file, &mesh),
        AnyMesh::Triangles(mesh) => {
            surface_info(&mesh);
            Ok(())
        }
    }
}

fn info(file: &Path, mesh: &TetrahedralMesh) -> Result<(), MeshError> {
    fem_mesh::check(mesh, file)?;
    say!("{}", fem_mesh::quality(mesh).to_string().trim_end());
    let parts: HashSet<usize> = fem_mesh::parts(mesh).into_iter().collect();
    say!("{:<26}{:>12}", "connected parts", parts.len());
    let coincident = fem_mesh::coincident_nodes(mesh).map_or("0".to_owned(), |found| {
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

fn surface_info(mesh: &SurfaceMesh) {
    say!("{}", fem_mesh::surface_quality(mesh).to_string().trim_end());
    for (name, set) in &mesh.sets {
        say!("set {name:?}: {}", set.counts_of_triangles());
    }
}
