//! The meshes that a scene names.

use std::path::{Path, PathBuf};

use super::load::line_of;
use super::{Scene, SceneError, nodes};
use crate::simulation::Shape;
use fem_mesh::{MeshError, Problem, SurfaceMesh, TetrahedralMesh};

/// A scene's meshes, scaled, checked, and what the scene says of their nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Nodes, tetrahedra and surfaces.
    pub shape: Shape,
    /// Nodes that never move, ascending, each once; `None` where the scene fixes none.
    pub fixed: Option<Vec<usize>>,
    /// Nodes of each `[[prescribed]]`, ascending. No coordinate is prescribed twice, none of a fixed node at all.
    pub prescribed: Vec<Vec<usize>>,
    /// Boundary triangles of each `[[traction]]`, outward.
    pub loaded_faces: Vec<Vec<[usize; 3]>>,
    /// Rest length of each of `[[springs]]`, m.
    pub rest_lengths: Vec<f64>,
    /// The node that the scripted drag pulls.
    pub dragged: Option<usize>,
    /// Factor of the moduli of each element; empty where the scene's are those of all. No scene file has it.
    pub stiffer: Vec<f64>,
    /// The same of the density.
    pub denser: Vec<f64>,
}

/// Reads and checks the meshes of a scene. Files are looked for beside the scene and then in `data`.
pub fn body(scene: &Scene, data: &Path) -> Result<Body, SceneError> {
    body_of(scene, tetrahedra(scene, data)?, data)
}

/// The same with tetrahedra that are in memory already, in place of those that the scene names.
pub fn body_of(scene: &Scene, mesh: TetrahedralMesh, data: &Path) -> Result<Body, SceneError> {
    let mesh = checked(scene, mesh)?;
    let display = scene.mesh.display.as_ref().map(|file| surface(scene, data, file)).transpose()?;
    let boundary = fem_mesh::boundary(&mesh);
    let fixed = scene.fixed.as_ref().map(|fixed| nodes::fixed(scene, fixed, &mesh)).transpose()?;
    Ok(Body {
        prescribed: nodes::prescribed(scene, fixed.as_deref(), &mesh)?,
        loaded_faces: nodes::loaded_faces(scene, &mesh, &boundary)?,
        rest_lengths: nodes::rest_lengths(scene, &mesh)?,
        dragged: scene.drag.as_ref().map(|drag| nodes::dragged(scene, drag, &mesh)).transpose()?,
        stiffer: Vec::new(),
        denser: Vec::new(),
        fixed,
        shape: Shape { mesh, boundary, display },
    })
}

/// Scaled, checked and refined.
fn checked(scene: &Scene, mesh: TetrahedralMesh) -> Result<TetrahedralMesh, SceneError> {
    let mesh = scale(mesh, scene.mesh.scale);
    let source = scene.mesh.file.clone().unwrap_or_else(|| PathBuf::from("box"));
    fem_mesh::check(&mesh, &source).map_err(|error| mesh_error(scene, "mesh", error))?;
    if scene.mesh.refine == 0 {
        return Ok(mesh);
    }
    let refined = fem_mesh::refine(mesh, scene.mesh.refine, &source);
    // Small elements far from the origin can lose their volume to rounding.
    let checked = refined.and_then(|mesh| fem_mesh::check(&mesh, &source).map(|()| mesh));
    checked.map_err(|error| mesh_error(scene, "mesh.refine", error))
}

fn tetrahedra(scene: &Scene, data: &Path) -> Result<TetrahedralMesh, SceneError> {
    match (&scene.mesh.file, &scene.mesh.cuboid) {
        (Some(file), _) => {
            let path = find(scene, data, file);
            fem_mesh::read_tetrahedra(&path).map_err(|error| mesh_error(scene, "mesh.file", error))
        }
        (None, Some(cuboid)) => {
            fem_mesh::box_mesh(cuboid.size, cuboid.cells_per_unit).map_err(|error| mesh_error(scene, "mesh.box", error))
        }
        (None, None) => unreachable!("a scene without tetrahedra is refused when it is read"),
    }
}

fn surface(scene: &Scene, data: &Path, file: &Path) -> Result<SurfaceMesh, SceneError> {
    let path = find(scene, data, file);
    let surface = fem_mesh::read_surface(&path).map(|surface| scale(surface, scene.mesh.scale));
    surface.and_then(|surface| finite(surface, &path)).map_err(|error| mesh_error(scene, "mesh.display", error))
}

/// A scale can make what was read infinite.
fn finite(surface: SurfaceMesh, source: &Path) -> Result<SurfaceMesh, MeshError> {
    match surface.vertices.iter().position(|x| !x.iter().all(|coordinate| coordinate.is_finite())) {
        Some(vertex) => Err(MeshError::in_file(source, Problem::VertexNotFinite { vertex })),
        None => Ok(surface),
    }
}

fn scale<const N: usize>(mut mesh: fem_mesh::Mesh<3, N>, factor: f64) -> fem_mesh::Mesh<3, N> {
    for vertex in &mut mesh.vertices {
        *vertex *= factor;
    }
    mesh
}

/// Beside the scene, else in `data`; an absolute path is what it is.
fn find(scene: &Scene, data: &Path, file: &Path) -> PathBuf {
    let beside = scene.path.parent().unwrap_or(Path::new("")).join(file);
    if beside.exists() { beside } else { data.join(file) }
}

fn mesh_error(scene: &Scene, field: &'static str, error: MeshError) -> SceneError {
    SceneError::Mesh { file: scene.path.clone(), line: line(scene, field), field, error }
}

impl Scene {
    /// The error of a pipeline that cannot run the scene because of this field, such as `time.integrator`.
    pub fn refuse(&self, field: &str, problem: &str) -> SceneError {
        SceneError::Line { file: self.path.clone(), line: line(self, field), problem: format!("{field} {problem}") }
    }
}

/// Read anew, because only a scene that is refused needs it.
fn line(scene: &Scene, field: &str) -> usize {
    std::fs::read_to_string(&scene.path).map_or(1, |text| line_of(&text, field))
}
