//! `mesh from-surface`: tetrahedra inside a surface, or around it.

use std::collections::HashSet;
use std::path::PathBuf;

use fem_mesh::generate::odt::{improve_inside, improve_tetrahedra};
use fem_mesh::generate::{Solid, cage, keep_features, stuff_graded};
use fem_mesh::{MeshError, Problem, SurfaceMesh, TetrahedralMesh};

use super::{tell, write_tetrahedra};
use crate::progress;

/// Arguments of the subcommand.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    surface: PathBuf,
    out: PathBuf,
    /// Mean length of an edge, m
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    edge: f64,
    /// Number of times that edges may double towards the inside
    #[arg(long, value_name = "N", default_value_t = 0)]
    grading: usize,
    /// Keeps edges and corners of the surface where normals differ by more than this angle, degrees
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    features: Option<f64>,
    /// Passes of improvement, in which the nodes of the boundary slide on the surface
    #[arg(long, value_name = "N", default_value_t = 0)]
    improve: usize,
    /// Tetrahedra around the surface instead, which contain it wholly: a display surface follows them
    #[arg(long, conflicts_with_all = ["grading", "features", "improve"])]
    cage: bool,
}

/// Fills the surface and writes the tetrahedra.
pub fn run(arguments: &Arguments) -> Result<(), MeshError> {
    let Arguments { surface: file, out, edge, grading, features, improve, cage: is_cage } = arguments;
    fem_mesh::write::check_tetrahedra(out)?;
    let found = fem_mesh::read_file(file)?;
    tell(file, &found.notes);
    let surface = found.triangles(file)?;
    let made = if *is_cage {
        progress::during("enclosing the surface", || cage(&surface, *edge))
    } else {
        progress::with_share("filling the surface", |told| stuff_graded(&surface, *edge, *grading, told))
    };
    let mesh = made.map_err(|error| MeshError::in_file(file, Problem::Stuffing(error)))?;
    fem_mesh::check(&mesh, file)?;
    if *is_cage {
        return write_tetrahedra(out, &mesh);
    }
    let mesh = progress::with_share("improving the elements", |told| match features {
        None => improve_inside(&mesh, *improve, &Solid::new(&surface), told).mesh,
        Some(angle) => improve_tetrahedra(&with_features(&mesh, &surface, *angle), *improve, told).mesh,
    });
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
    let parts = fem_mesh::parts(mesh.vertices.len(), &mesh.elements).into_iter().collect::<HashSet<_>>().len();
    if parts != faults.parts {
        eprintln!(
            "warning: {}: the mesh has {parts} connected parts and the surface {}; shorter edges keep thin places",
            out.display(),
            faults.parts
        );
    }
    write_tetrahedra(out, &mesh)
}

/// Moves the boundary onto the feature lines of the surface and prints how much of them it keeps.
fn with_features(mesh: &TetrahedralMesh, surface: &SurfaceMesh, angle: f64) -> TetrahedralMesh {
    let found = keep_features(mesh, surface, angle);
    say!("feature lines: {:.6} m, of which the mesh keeps {:.6} m", found.length, found.kept);
    found.mesh
}

fn angle(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(angle) if angle > 0.0 && angle < 180.0 => Ok(angle),
        _ => Err("give an angle above 0 and below 180 degrees, such as 40".to_owned()),
    }
}
