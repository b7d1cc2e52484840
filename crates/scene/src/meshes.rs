//! The meshes that a scene names: files, boxes, surfaces to fill.

use std::path::{Path, PathBuf};

use fem_mesh::generate::odt::improve_inside;
use fem_mesh::generate::{Solid, stuff_graded};
use fem_mesh::{AnyMesh, MeshError, MeshFile, Problem, SurfaceMesh};

use crate::error::of_field;
use crate::load::line_of;
use crate::paths::find;
use crate::tables::MeshTable;
use crate::{Scene, SceneError};
use fem_model::BodyMesh;

/// A mesh file's content; adds its remarks to `notes`.
fn read(path: &Path, file: &Path, notes: &mut Vec<String>) -> Result<MeshFile, MeshError> {
    let mut found = fem_mesh::read_file(path)?;
    notes.extend(found.notes.drain(..).map(|note| format!("mesh {}: {note}", file.display())));
    Ok(found)
}

/// The elements of a mesh that is not made from a picture.
pub(crate) fn elements(scene: &Scene, data: &Path, notes: &mut Vec<String>) -> Result<BodyMesh, SceneError> {
    match &scene.mesh {
        MeshTable { file: Some(file), .. } if fem_mesh::is_surface(file) => {
            let mesh = fem_mesh::read_tetrahedra(&find(scene, data, file));
            mesh.map(BodyMesh::solid).map_err(|error| mesh_error(scene, "mesh.file", error))
        }
        MeshTable { file: Some(file), .. } => {
            let found = read(&find(scene, data, file), file, notes);
            match found.map_err(|error| mesh_error(scene, "mesh.file", error))?.mesh {
                AnyMesh::Tetrahedra(mesh) => Ok(mesh.into()),
                AnyMesh::Triangles(mesh) => Ok(flat_body(scene, mesh)),
            }
        }
        MeshTable { files: Some(files), .. } => {
            // Each is checked alone, so that an error names its file.
            let checked = |file: &PathBuf| {
                let path = find(scene, data, file);
                let mesh = read(&path, file, notes).and_then(|found| found.tetrahedra(&path)).and_then(|mesh| {
                    fem_mesh::check(&mesh, file)?;
                    Ok((name_of(file), mesh))
                });
                mesh.map_err(|error| mesh_error(scene, "mesh.files", error))
            };
            Ok(fem_mesh::join(files.iter().map(checked).collect::<Result<Vec<_>, SceneError>>()?).into())
        }
        MeshTable { cuboid: Some(cuboid), .. } => {
            let mesh = fem_mesh::box_mesh(cuboid.size, cuboid.cells_per_unit, cuboid.pattern);
            mesh.map(BodyMesh::solid).map_err(|error| mesh_error(scene, "mesh.box", error))
        }
        MeshTable { surface: Some(surface), .. } => {
            let path = find(scene, data, &surface.file);
            let triangles = read(&path, &surface.file, notes).and_then(|found| found.triangles(&path));
            let mesh = triangles.and_then(|triangles| {
                let mesh = stuff_graded(&triangles, surface.edge, surface.grading, &|_| ())
                    .map_err(|error| MeshError::in_file(&path, Problem::Stuffing(error)))?;
                fem_mesh::check(&mesh, &path)?;
                Ok(improve_inside(&mesh, surface.improve, &Solid::new(&triangles), &|_| ()).mesh)
            });
            mesh.map(BodyMesh::solid).map_err(|error| mesh_error(scene, "mesh.surface", error))
        }
        MeshTable { rectangle: Some(rectangle), .. } => {
            let mesh = fem_mesh::rectangle_mesh(rectangle.size, rectangle.cells_per_unit, rectangle.pattern);
            mesh.map(|triangles| flat_body(scene, triangles))
                .map_err(|error| mesh_error(scene, "mesh.rectangle", error))
        }
        _ => unreachable!("a scene without elements is refused when it is read"),
    }
}

/// A flat body of the scene's thickness.
pub(crate) fn flat_body(scene: &Scene, triangles: SurfaceMesh) -> BodyMesh {
    BodyMesh::flat(triangles, scene.material.thickness.unwrap_or(1.0))
}

/// The name of a mesh file without its extensions: `wheel` of `meshes/wheel.node.gz`.
pub(crate) fn name_of(file: &Path) -> String {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    name.split('.').next().unwrap_or_default().to_owned()
}

/// The display surface; adds the remarks on its file to `notes`.
pub(crate) fn surface(
    scene: &Scene,
    data: &Path,
    file: &Path,
    notes: &mut Vec<String>,
) -> Result<SurfaceMesh, SceneError> {
    let path = find(scene, data, file);
    let surface = read(&path, file, notes).and_then(|found| found.triangles(&path));
    let surface = surface.map(|surface| scale(surface, scene.mesh.scale));
    surface.and_then(|surface| finite(surface, &path)).map_err(|error| mesh_error(scene, "mesh.display", error))
}

/// Checks the scaled coordinates, which a large scale can make infinite.
fn finite(surface: SurfaceMesh, source: &Path) -> Result<SurfaceMesh, MeshError> {
    match surface.vertices.iter().position(|x| !x.iter().all(|coordinate| coordinate.is_finite())) {
        Some(vertex) => Err(MeshError::in_file(source, Problem::VertexNotFinite { vertex })),
        None => Ok(surface),
    }
}

/// The mesh times a factor.
pub(crate) fn scale<const N: usize>(mut mesh: fem_mesh::Mesh<3, N>, factor: f64) -> fem_mesh::Mesh<3, N> {
    for vertex in &mut mesh.vertices {
        *vertex *= factor;
    }
    mesh
}

/// The error of a mesh, at the line of its field or with the override that set it.
pub(crate) fn mesh_error(scene: &Scene, field: &'static str, error: MeshError) -> SceneError {
    if let Some(change) = scene.overrides.iter().rev().find(|change| change.concerns(field)) {
        return SceneError::Override { option: change.to_string(), problem: of_field(field, &error) };
    }
    SceneError::Mesh { file: scene.path.clone(), line: line_of(&scene.text.0, field), field, error }
}
