//! The meshes that a scene names.

use std::path::{Path, PathBuf};

use super::load::line_of;
use super::{Drag, DragVertex, Fixed, Scene, SceneError};
use crate::mesh::{self, MeshError, SurfaceMesh, TetrahedralMesh};
use crate::simulation::Shape;

/// A scene's meshes, scaled, checked, and what the scene says of their nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Nodes, tetrahedra and surfaces.
    pub shape: Shape,
    /// Nodes that never move, ascending, each once; `None` where the scene fixes none.
    pub fixed: Option<Vec<usize>>,
    /// The node that the scripted drag pulls.
    pub dragged: Option<usize>,
}

/// Reads and checks the meshes of a scene. Files are looked for beside the scene and then in `data`.
pub fn body(scene: &Scene, data: &Path) -> Result<Body, SceneError> {
    let mesh = scale(tetrahedra(scene, data)?, scene.mesh.scale);
    let source = scene.mesh.file.clone().unwrap_or_else(|| PathBuf::from("box"));
    mesh::check(&mesh, &source).map_err(|error| mesh_error(scene, "mesh", error))?;

    let display = scene.mesh.display.as_ref().map(|file| surface(scene, data, file)).transpose()?;
    let fixed = scene.fixed.as_ref().map(|fixed| fixed_nodes(scene, fixed, &mesh)).transpose()?;
    let dragged = scene.drag.as_ref().map(|drag| dragged_node(scene, drag, &mesh)).transpose()?;
    let boundary = mesh::boundary(&mesh);
    Ok(Body { shape: Shape { mesh, boundary, display }, fixed, dragged })
}

fn tetrahedra(scene: &Scene, data: &Path) -> Result<TetrahedralMesh, SceneError> {
    match (&scene.mesh.file, &scene.mesh.cuboid) {
        (Some(file), _) => {
            let path = find(scene, data, file);
            mesh::read_tetrahedra(&path).map_err(|error| mesh_error(scene, "mesh.file", error))
        }
        (None, Some(cuboid)) => {
            mesh::box_mesh(cuboid.size, cuboid.cells_per_unit).map_err(|error| mesh_error(scene, "mesh.box", error))
        }
        (None, None) => unreachable!("a scene without tetrahedra is refused when it is read"),
    }
}

fn surface(scene: &Scene, data: &Path, file: &Path) -> Result<SurfaceMesh, SceneError> {
    let surface = mesh::read_surface(&find(scene, data, file));
    surface.map(|surface| scale(surface, scene.mesh.scale)).map_err(|error| mesh_error(scene, "mesh.display", error))
}

fn scale<const N: usize>(mut mesh: mesh::Mesh<3, N>, factor: f64) -> mesh::Mesh<3, N> {
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

fn fixed_nodes(scene: &Scene, fixed: &Fixed, mesh: &TetrahedralMesh) -> Result<Vec<usize>, SceneError> {
    if let Some(plane) = &fixed.plane {
        let coordinate = |node: usize| mesh.vertices[node][plane.axis as usize];
        let all = 0..mesh.vertices.len();
        let smallest = all.clone().map(coordinate).fold(f64::INFINITY, f64::min);
        return Ok(all.filter(|&node| coordinate(node) <= smallest + plane.below).collect());
    }
    let mut nodes = fixed.nodes.clone().unwrap_or_default();
    nodes.sort_unstable();
    nodes.dedup();
    match nodes.last() {
        Some(&node) if node >= mesh.vertices.len() => Err(no_such_node(scene, "fixed.nodes", node, mesh)),
        _ => Ok(nodes),
    }
}

fn dragged_node(scene: &Scene, drag: &Drag, mesh: &TetrahedralMesh) -> Result<usize, SceneError> {
    match drag.vertex {
        DragVertex::Index(node) if node >= mesh.vertices.len() => Err(no_such_node(scene, "drag.vertex", node, mesh)),
        DragVertex::Index(node) => Ok(node),
        DragVertex::Highest => {
            let heights = mesh.vertices.iter().map(|vertex| vertex.y).enumerate();
            let higher = |best: (usize, f64), next: (usize, f64)| if next.1 > best.1 { next } else { best };
            Ok(heights.fold((0, f64::NEG_INFINITY), higher).0)
        }
    }
}

fn no_such_node(scene: &Scene, field: &str, node: usize, mesh: &TetrahedralMesh) -> SceneError {
    scene.refuse(field, &format!("names node {node}; the mesh has nodes 0 to {}", mesh.vertices.len() - 1))
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
