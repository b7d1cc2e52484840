//! `mesh`: measures, converts and makes meshes.

use std::collections::HashSet;
use std::path::Path;

use fem_mesh::generate::delaunay::{DelaunayError, tetrahedralize, triangulate};
use fem_mesh::generate::stuff;
use fem_mesh::{MeshError, Points, Problem, SurfaceMesh, TetrahedralMesh};

use super::cli::MeshAction;
use super::end::End;

/// Runs a subcommand of `mesh`.
pub fn run(action: &MeshAction) -> Result<(), End> {
    match action {
        MeshAction::Info { file } if fem_mesh::is_surface(file) => surface_info(file).map_err(End::unusable),
        MeshAction::Info { file } => info(file).map_err(End::unusable),
        MeshAction::Convert { from, to } if fem_mesh::is_surface(from) => {
            fem_mesh::read_surface(from).and_then(|mesh| write_surface(to, &mesh)).map_err(End::unusable)
        }
        MeshAction::Convert { from, to } => convert(from, to).map_err(End::unusable),
        MeshAction::Delaunay { points, out } => delaunay(points, out),
        MeshAction::FromSurface { surface, out, edge } => from_surface(surface, out, *edge).map_err(End::unusable),
    }
}

fn info(file: &Path) -> Result<(), MeshError> {
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

fn surface_info(file: &Path) -> Result<(), MeshError> {
    let mesh = fem_mesh::read_surface(file)?;
    say!("{}", fem_mesh::surface_quality(&mesh).to_string().trim_end());
    Ok(())
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

/// Triangles or tetrahedra, as the points have two or three coordinates.
fn delaunay(points: &Path, out: &Path) -> Result<(), End> {
    let unusable = |error: DelaunayError| End::unusable(format!("{}: {error}", points.display()));
    let (count, vertices) = match fem_mesh::read_points(points).map_err(End::unusable)? {
        Points::InPlane(points) => {
            let found = triangulate(&points).map_err(unusable)?.mesh;
            let vertices = found.vertices.iter().map(|x| x.push(0.0)).collect();
            write_surface(out, &SurfaceMesh::new(vertices, found.elements)).map_err(End::unusable)?;
            (points.len(), found.vertices.len())
        }
        Points::InSpace(points) => {
            let found = tetrahedralize(&points).map_err(unusable)?.mesh;
            write_tetrahedra(out, &found).map_err(End::unusable)?;
            (points.len(), found.vertices.len())
        }
    };
    if vertices < count {
        say!("{} points are at the place of an earlier one and share its node", count - vertices);
    }
    Ok(())
}

fn from_surface(file: &Path, out: &Path, edge: f64) -> Result<(), MeshError> {
    let surface = fem_mesh::read_surface(file)?;
    let mesh = stuff(&surface, edge).map_err(|error| MeshError::in_file(file, Problem::Stuffing(error)))?;
    fem_mesh::check(&mesh, file)?;
    let faults = fem_mesh::surface_quality(&surface);
    if !faults.is_closed() {
        eprintln!(
            "warning: {}: the surface has {} open edges, {} edges of over 2 triangles and {} of flipped triangles; its inside is \
             where it winds around more than half",
            file.display(),
            faults.open_edges,
            faults.branching_edges,
            faults.flipped_edges
        );
    }
    let parts = fem_mesh::parts(&mesh).into_iter().collect::<HashSet<_>>().len();
    if parts != faults.parts {
        eprintln!(
            "warning: {}: the mesh has {parts} connected parts and the surface {}; shorter edges keep thin places",
            out.display(),
            faults.parts
        );
    }
    write_tetrahedra(out, &mesh)
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
