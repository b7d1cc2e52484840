//! The body of a scene.

use std::path::{Path, PathBuf};

use fem_model::simulation::Shape;
use fem_model::{Body, BodyMesh, Refusal, density_factors};

use crate::check::flat;
use crate::meshes::{elements, flat_body, mesh_error, surface};
use crate::paths::find;
use crate::tables::{MeshTable, SurfaceTable};
use crate::values::{
    contact, curve, damping, dirichlet_conditions, drag, fibres, initial_velocity, nodal_forces, plasticity, regions,
    springs, surface_loads,
};
use crate::{Scene, SceneError, picture};

/// Reads and checks the meshes of a scene, and builds the body. A mesh file is searched beside the scene, then in `data`.
pub fn body(scene: &Scene, data: &Path) -> Result<Body, SceneError> {
    let Some(table) = &scene.mesh.picture else {
        let mut notes = Vec::new();
        let mut body = body_of(scene, elements(scene, data, &mut notes)?, data)?;
        body.notes.splice(0..0, notes);
        return Ok(body);
    };
    let found = picture::triangles(table, &find(scene, data, &table.file), scene.mesh.scale);
    let (triangles, place, remark) = found.map_err(|text| scene.refuse("mesh.picture", &text))?;
    let mut body = body_of(scene, flat_body(scene, triangles), data)?;
    body.shape.picture = Some(place);
    body.notes.extend(remark.map(|remark| format!("mesh.picture {}: {remark}", table.file.display())));
    Ok(body)
}

/// Builds the body on a mesh in memory, in place of the one that the scene names.
pub fn body_of(scene: &Scene, mesh: impl Into<BodyMesh>, data: &Path) -> Result<Body, SceneError> {
    let mesh = checked(scene, mesh.into())?;
    let mut notes = Vec::new();
    let display = scene.mesh.display.as_ref().map(|file| surface(scene, data, file, &mut notes)).transpose()?;
    let boundary = mesh.surface();
    let mut body = body_of_shape(scene, Shape { mesh, boundary, display, picture: None }, data)?;
    body.notes = notes;
    Ok(body)
}

/// Builds the body of a shape that was made for a scene with the same `[mesh]`.
pub fn body_of_shape(scene: &Scene, shape: Shape, data: &Path) -> Result<Body, SceneError> {
    values(scene, shape, data).map_err(|refusal| scene.refused(refusal))
}

fn values(scene: &Scene, shape: Shape, data: &Path) -> Result<Body, Refusal> {
    let check = if shape.mesh.dimension() == 2 { flat::check } else { flat::check_solid };
    check(scene)?;
    let mut body = Body::of_shape(shape, scene.material.value());
    let mesh = &body.shape.mesh;
    body.name.clone_from(&scene.name);
    body.dirichlet = dirichlet_conditions(scene, mesh)?;
    (body.tractions, body.pressures) = surface_loads(scene, &body.shape)?;
    body.regions = regions(scene, mesh)?;
    body.density_factors = density_factors(&body.regions, body.material.density, mesh.elements());
    let density = |element: usize| body.material.density * body.density_factors.get(element).copied().unwrap_or(1.0);
    body.initial_velocity = initial_velocity(scene, mesh, density, |file| find(scene, data, file))?;
    body.gravity = scene.gravity.as_ref().map(|gravity| gravity.acceleration.into());
    body.gravity_curve = scene.gravity.as_ref().and_then(|gravity| curve(&gravity.curve));
    body.body_force = scene.body_force.as_ref().map(|force| force.density.into());
    body.body_force_curve = scene.body_force.as_ref().and_then(|force| curve(&force.curve));
    body.plasticity = plasticity(scene);
    body.fibres = fibres(scene, mesh, |file| find(scene, data, file))?;
    body.lumped_mass = scene.lumps_mass(mesh.vertices().len());
    body.nodal_forces = nodal_forces(scene, mesh)?;
    body.fields = scene.fields();
    body.fields.check_on(mesh)?;
    body.springs = springs(scene, mesh)?;
    body.drag = drag(scene, mesh)?;
    body.damping = damping(scene);
    body.contact = contact(scene, &body)?;
    Ok(body)
}

/// Scales, checks and refines a mesh of linear elements, and gives them their order. Others, of a program's own, are what they are.
fn checked(scene: &Scene, mesh: BodyMesh) -> Result<BodyMesh, SceneError> {
    if mesh.element().order != 1 {
        return Ok(mesh);
    }
    let source = source(scene);
    let mesh = mesh.scaled(scene.mesh.scale).checked(&source).map_err(|error| mesh_error(scene, "mesh", error))?;
    let refined = match scene.mesh.refine {
        0 => Ok(mesh),
        // Small elements far from the origin can lose their volume to rounding.
        times => mesh.refined(times, &source).and_then(|mesh| mesh.checked(&source)),
    };
    let mesh = refined.map_err(|error| mesh_error(scene, "mesh.refine", error))?;
    let (order, name) = (scene.mesh.order, mesh.element().name);
    mesh.of_order(order as usize).ok_or_else(|| {
        let text = format!("is {order}, and there are no {name} of this order; write 1, or 2");
        scene.refuse("mesh.order", &text)
    })
}

/// The name of the mesh in messages.
fn source(scene: &Scene) -> PathBuf {
    match &scene.mesh {
        MeshTable { file: Some(file), .. } | MeshTable { surface: Some(SurfaceTable { file, .. }), .. } => file.clone(),
        MeshTable { files: Some(_), .. } => PathBuf::from("files"),
        MeshTable { picture: Some(picture), .. } => picture.file.clone(),
        MeshTable { rectangle: Some(_), .. } => PathBuf::from("rectangle"),
        _ => PathBuf::from("box"),
    }
}
