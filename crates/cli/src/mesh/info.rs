//! `mesh info`: counts, sizes and shapes.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use fem_mesh::{
    AnyMesh, Distribution, MeshError, MeshFile, SurfaceMesh, TetrahedralMesh, boundary, self_intersections,
    surface_quality, tetrahedron_distributions, triangle_distributions,
};

use super::{shapes, tell};
use crate::end::End;
use crate::engine;

/// Arguments of the subcommand.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    file: PathBuf,
    /// Draw the mesh and the histograms
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
    /// Print the condition number of the stiffness that tetrahedra lead to
    #[arg(long)]
    stiffness: bool,
}

/// Prints the measures of a mesh or of a surface.
pub fn run(arguments: &Arguments) -> Result<(), End> {
    let file = &arguments.file;
    arguments.picture.as_deref().map_or(Ok(()), shapes::check).map_err(End::unusable)?;
    let MeshFile { mesh, notes, program } = fem_mesh::read_file(file).map_err(End::unusable)?;
    let (surface, distributions) = match &mesh {
        AnyMesh::Tetrahedra(mesh) => {
            info(file, mesh).map_err(End::unusable)?;
            (surface_of(mesh), tetrahedron_distributions(mesh))
        }
        AnyMesh::Triangles(_) if arguments.stiffness => {
            let problem = format!("--stiffness: {} has no tetrahedra; give a mesh that has some", file.display());
            return Err(End::unusable(problem));
        }
        AnyMesh::Triangles(mesh) => {
            surface_info(mesh);
            (mesh.clone(), triangle_distributions(mesh))
        }
    };
    if let Some(program) = program {
        say!("{:<26}{program:>12}", "written by");
    }
    tell(file, &notes);
    shapes::print(&distributions);
    if let AnyMesh::Tetrahedra(mesh) = &mesh
        && arguments.stiffness
    {
        engine::print_conditioning(mesh)?;
    }
    draw(arguments, &surface, &distributions).map_err(End::unusable)
}

fn draw(arguments: &Arguments, surface: &SurfaceMesh, distributions: &[Distribution]) -> Result<(), MeshError> {
    let Some(picture) = &arguments.picture else { return Ok(()) };
    let name = arguments.file.file_name().unwrap_or_default().to_string_lossy();
    shapes::draw(picture, &name, surface, distributions)?;
    say!();
    say!("{}: the mesh and its histograms", picture.display());
    Ok(())
}

fn info(file: &Path, mesh: &TetrahedralMesh) -> Result<(), MeshError> {
    fem_mesh::check(mesh, file)?;
    say!("{}", fem_mesh::quality(mesh).to_string().trim_end());
    let parts: HashSet<usize> = fem_mesh::parts(mesh.vertices.len(), &mesh.elements).into_iter().collect();
    say!("{:<26}{:>12}", "connected parts", parts.len());
    let coincident = fem_mesh::coincident_nodes(&mesh.vertices).map_or("0".to_owned(), |found| {
        let [a, b] = found.first;
        format!("{} (the first: {a} and {b})", found.count)
    });
    say!("{:<26}{coincident:>12}", "coincident nodes");
    // The check refuses a mesh that has some.
    say!("{:<26}{:>12}", "duplicate elements", 0);
    boundary_info(&surface_of(mesh));
    for (name, set) in &mesh.sets {
        say!("set {name:?}: {}, {} nodes", set.counts(), set.nodes(|element| &mesh.elements[element]).len());
    }
    Ok(())
}

/// The boundary alone, with vertices of its own.
fn surface_of(mesh: &TetrahedralMesh) -> SurfaceMesh {
    let mut elements = boundary(mesh);
    let mut numbers = vec![usize::MAX; mesh.vertices.len()];
    let mut vertices = Vec::new();
    for vertex in elements.iter_mut().flatten() {
        if numbers[*vertex] == usize::MAX {
            numbers[*vertex] = vertices.len();
            vertices.push(mesh.vertices[*vertex]);
        }
        *vertex = numbers[*vertex];
    }
    SurfaceMesh::new(vertices, elements)
}

fn boundary_info(surface: &SurfaceMesh) {
    let found = surface_quality(surface);
    let rows = [
        ("boundary: closed", yes(found.is_closed()).to_owned()),
        ("boundary: manifold", yes(found.is_manifold()).to_owned()),
        ("boundary: parts", found.parts.to_string()),
        ("boundary: Euler number", found.euler_characteristic.to_string()),
        ("boundary: area, m²", format!("{:.6e}", found.area)),
        ("self-intersections", crossings(surface)),
    ];
    rows.iter().for_each(|(name, figure)| say!("{name:<26}{figure:>12}"));
}

fn surface_info(mesh: &SurfaceMesh) {
    let found = surface_quality(mesh);
    say!("{}", found.to_string().trim_end());
    let rows = [
        ("closed", yes(found.is_closed()).to_owned()),
        ("manifold", yes(found.is_manifold()).to_owned()),
        ("self-intersections", crossings(mesh)),
    ];
    rows.iter().for_each(|(name, figure)| say!("{name:<26}{figure:>12}"));
    for (name, set) in &mesh.sets {
        say!(
            "set {name:?}: {}, {} nodes",
            set.counts_of_triangles(),
            set.nodes(|element| &mesh.elements[element]).len()
        );
    }
}

fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "no" }
}

/// Number of crossing pairs of triangles, and the first.
fn crossings(mesh: &SurfaceMesh) -> String {
    let found = self_intersections(mesh);
    let count = format!("{}{}", if found.has_more { "at least " } else { "" }, found.count);
    match found.first {
        Some([a, b]) => format!("{count} (the first: triangles {a} and {b})"),
        None => count,
    }
}
