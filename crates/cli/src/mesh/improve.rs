//! `mesh improve`: better elements for the same body.

use std::path::PathBuf;

use fem_mesh::generate::odt::{improve_tetrahedra, improve_triangles};
use fem_mesh::{AnyMesh, Mesh, MeshError, MeshFile, Quality, SurfaceMesh, TetrahedralMesh, TriangleQuality};
use fem_mesh::{quality, triangle_quality};

use super::{tell, write_surface, write_tetrahedra};
use crate::end::End;
use crate::progress;

/// Arguments of the subcommand.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    mesh: PathBuf,
    out: PathBuf,
    /// Iterations of optimal Delaunay triangulation, and passes over the worst elements after them
    #[arg(long, value_name = "N", default_value_t = 10)]
    iterations: usize,
}

/// Improves a mesh, prints its quality before and after, and writes it.
pub fn run(arguments: &Arguments) -> Result<(), End> {
    let MeshFile { mesh, notes, .. } = fem_mesh::read_file(&arguments.mesh).map_err(End::unusable)?;
    match mesh {
        AnyMesh::Tetrahedra(mesh) => tetrahedra(arguments, &mesh).map_err(End::unusable)?,
        AnyMesh::Triangles(mesh) => triangles(arguments, &mesh)?,
    }
    tell(&arguments.mesh, &notes);
    Ok(())
}

fn tetrahedra(arguments: &Arguments, mesh: &TetrahedralMesh) -> Result<(), MeshError> {
    fem_mesh::write::check_tetrahedra(&arguments.out)?;
    fem_mesh::check(mesh, &arguments.mesh)?;
    let improved = progress::with_share("improving the elements", |progress| {
        improve_tetrahedra(mesh, arguments.iterations, progress)
    });
    write_tetrahedra(&arguments.out, &improved.mesh)?;
    print_both(&quality(mesh), &quality(&improved.mesh));
    if let Some(lost) = fem_mesh::write::lost_sets(&arguments.out, mesh) {
        eprintln!("warning: {}: {lost}", arguments.out.display());
    }
    Ok(())
}

/// Improves a flat body.
fn triangles(arguments: &Arguments, mesh: &SurfaceMesh) -> Result<(), End> {
    fem_mesh::write::check_surface(&arguments.out).map_err(End::unusable)?;
    fem_mesh::check_plane(mesh, &arguments.mesh).map_err(End::unusable)?;
    let plane = Mesh {
        vertices: mesh.vertices.iter().map(|x| x.xy()).collect(),
        elements: mesh.elements.clone(),
        sets: mesh.sets.clone(),
    };
    let improved = progress::during("improving the elements", || improve_triangles(&plane, arguments.iterations))
        .map_err(|error| End::unusable(format!("{}: {error}", arguments.mesh.display())))?;
    let vertices = improved.mesh.vertices.iter().map(|x| x.push(0.0)).collect();
    let out = SurfaceMesh { vertices, elements: improved.mesh.elements.clone(), sets: improved.mesh.sets.clone() };
    write_surface(&arguments.out, &out).map_err(End::unusable)?;
    let (before, after) = (triangle_quality(&plane), triangle_quality(&improved.mesh));
    say!("{:<28}{:>12}{:>12}", "", "before", "after");
    let row = |name: &str, value: &dyn Fn(&TriangleQuality) -> f64| {
        say!("{name:<28}{:>12.4}{:>12.4}", value(&before), value(&after));
    };
    row("smallest angle, °", &|quality| quality.angles[0].value);
    row("worst circumradius / edge", &|quality| quality.radius_to_edge.value);
    row("99 % of circumradius / edge", &|quality| quality.radius_to_edge_99);
    row("median circumradius / edge", &|quality| quality.median_radius_to_edge);
    Ok(())
}

/// Prints the measures of a mesh before and after improvement.
pub fn print_both(before: &Quality, after: &Quality) {
    say!("{:<28}{:>12}{:>12}", "", "before", "after");
    let row = |name: &str, value: &dyn Fn(&Quality) -> f64| {
        say!("{name:<28}{:>12.4}{:>12.4}", value(before), value(after));
    };
    row("smallest dihedral angle, °", &|quality| quality.dihedral_angles[0].value);
    row("largest dihedral angle, °", &|quality| quality.dihedral_angles[1].value);
    row("worst radius ratio (0…1)", &|quality| quality.radius_ratio.value);
    row("mean radius ratio (0…1)", &|quality| quality.mean_radius_ratio);
}
