//! `mesh from-surface`: tetrahedra inside a surface.

use std::collections::HashSet;
use std::path::PathBuf;

use fem_mesh::generate::odt::improve_inside;
use fem_mesh::generate::{Solid, stuff_graded};
use fem_mesh::{MeshError, Problem};

use super::write_tetrahedra;

/// Arguments of the subcommand.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    surface: PathBuf,
    out: PathBuf,
    /// Mean length of an edge, m
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    edge: f64,
    /// How often edges may double towards the inside
    #[arg(long, value_name = "N", default_value_t = 0)]
    grading: usize,
    /// Passes of improvement, in which the nodes of the boundary slide on the surface
    #[arg(long, value_name = "N", default_value_t = 0)]
    improve: usize,
}

/// Fills the surface and writes the tetrahedra.
pub fn run(arguments: &Arguments) -> Result<(), MeshError> {
    let Arguments { surface: file, out, edge, grading, improve } = arguments;
    let surface = fem_mesh::read_surface(file)?;
    let mesh =
        stuff_graded(&surface, *edge, *grading).map_err(|error| MeshError::in_file(file, Problem::Stuffing(error)))?;
    fem_mesh::check(&mesh, file)?;
    let mesh = improve_inside(&mesh, *improve, &Solid::new(&surface)).mesh;
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
