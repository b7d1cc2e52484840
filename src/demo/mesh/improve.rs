//! `mesh improve`: better elements for the same body.

use std::path::PathBuf;

use fem_mesh::generate::odt::improve_tetrahedra;
use fem_mesh::{MeshError, Quality, quality};

use super::write_tetrahedra;

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
pub fn run(arguments: &Arguments) -> Result<(), MeshError> {
    let Arguments { mesh: file, out, iterations } = arguments;
    let mesh = fem_mesh::read_tetrahedra(file)?;
    fem_mesh::check(&mesh, file)?;
    let improved = improve_tetrahedra(&mesh, *iterations);
    write_tetrahedra(out, &improved.mesh)?;
    print_both(&quality(&mesh), &quality(&improved.mesh));
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
