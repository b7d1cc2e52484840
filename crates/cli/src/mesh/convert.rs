//! `mesh convert`: from one format to another, with repairs.

use std::path::{Path, PathBuf};

use fem_mesh::{AnyMesh, Mesh, MeshError, MeshFile};
use fem_model::BodyMesh;

use super::{tell, write_surface, write_tetrahedra};

/// Arguments of the subcommand.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    from: PathBuf,
    to: PathBuf,
    /// Turn the tetrahedra of negative volume; triangles as most of their neighbours by area, or counter-clockwise in the plane z = 0
    #[arg(long)]
    orient: bool,
    /// Leave out elements without a size and those that repeat another
    #[arg(long)]
    clean: bool,
    /// Put a node on the middle of every edge: quadratic elements (.inp, .msh, .vtu, .vtk)
    #[arg(long)]
    quadratic: bool,
}

/// Reads tetrahedra or triangles and writes them as the extension of `to` says.
pub fn run(arguments: &Arguments) -> Result<(), MeshError> {
    let Arguments { from, to, orient, clean, quadratic } = arguments;
    let MeshFile { mesh, mut notes, .. } = fem_mesh::read_file(from)?;
    let lost = match mesh {
        AnyMesh::Tetrahedra(mesh) => {
            let mut mesh = if *clean { cleaned(mesh, &mut notes) } else { mesh };
            if *orient {
                let count = fem_mesh::turn_inverted(&mut mesh);
                notes.push(turned(count));
            }
            fem_mesh::check(&mesh, from)?;
            if *quadratic {
                write_quadratic::<10>(to, BodyMesh::solid(mesh.clone()))?;
            } else {
                write_tetrahedra(to, &mesh)?;
            }
            fem_mesh::write::lost_sets(to, &mesh)
        }
        AnyMesh::Triangles(mesh) => {
            let mut mesh = if *clean { cleaned(mesh, &mut notes) } else { mesh };
            if *orient && mesh.vertices.iter().all(|x| x.z == 0.0) {
                let count = fem_mesh::turn_inverted(&mut mesh);
                notes.push(turned(count));
            } else if *orient {
                let oriented = fem_mesh::oriented(&mesh);
                let pairs = std::iter::zip(&mesh.elements, &oriented.elements);
                notes.push(turned(pairs.filter(|(before, after)| before != after).count()));
                mesh = oriented;
            }
            if *quadratic {
                write_quadratic::<6>(to, BodyMesh::flat(mesh.clone(), 1.0))?;
            } else {
                write_surface(to, &mesh)?;
            }
            fem_mesh::write::lost_sets(to, &mesh)
        }
    };
    tell(from, &notes);
    lost.iter().for_each(|lost| eprintln!("warning: {}: {lost}", to.display()));
    Ok(())
}

fn write_quadratic<const N: usize>(to: &Path, mesh: BodyMesh) -> Result<(), MeshError> {
    // There are elements of either shape with nodes at the middles of their edges.
    let Some(mesh) = mesh.of_order(2).and_then(|mesh| mesh.mesh::<N>()) else { return Ok(()) };
    fem_mesh::write::write_quadratic(to, &mesh)?;
    say!("{}: {} nodes, {} quadratic elements", to.display(), mesh.vertices.len(), mesh.elements.len());
    Ok(())
}

fn cleaned<const N: usize>(mesh: Mesh<3, N>, notes: &mut Vec<String>) -> Mesh<3, N> {
    let (mesh, lines) = fem_mesh::without_faulty_elements(mesh);
    notes.extend(lines);
    mesh
}

fn turned(count: usize) -> String {
    format!("{count} elements are turned")
}
