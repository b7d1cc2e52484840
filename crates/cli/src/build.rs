//! Builds the simulation of a scene.

use std::time::Instant;

use fem_model::Body;
use fem_model::simulation::Simulation;
use fem_scene::{Pipeline, Scene};
use nalgebra::Vector3;

use crate::course::Course;
use crate::end::End;
use crate::{engine, progress};

/// A simulation that is ready to start.
pub struct Ready {
    pub simulation: Box<dyn Simulation>,
    pub seconds_setup: f64,
    pub steps: usize,
    /// Upward direction of pictures: against gravity, or against a cantilever's load; y without either.
    pub up: Vector3<f64>,
    /// Timoshenko's displacement of the tip, m, if the scene is a cantilever.
    pub expected_tip: Option<Vector3<f64>>,
}

/// Reads the meshes of a scene and builds its simulation.
pub fn build(course: &Course, scene: &Scene) -> Result<Ready, End> {
    let start = Instant::now();
    let body = body(course, scene)?;
    let expected_tip = engine::expected_tip_displacement(scene, &body);
    let simulation = match scene.pipeline {
        Pipeline::Course => (course.build)(scene, body).map_err(End::unusable)?,
        Pipeline::Engine => engine::build(scene, body)?,
    };
    warn_of_vertices_outside(scene, &*simulation);
    for note in simulation.notes() {
        eprintln!("note: {}: {note}", scene.path.display());
    }
    let seconds_setup = start.elapsed().as_secs_f64();
    let down = scene.gravity.as_ref().and_then(|gravity| Vector3::from(gravity.acceleration).try_normalize(0.0));
    // Without gravity a cantilever bends downwards.
    let down = down.or_else(|| expected_tip.and_then(|tip| tip.try_normalize(0.0)));
    let up = down.map_or(Vector3::y(), |down| -down);
    Ok(Ready { simulation, seconds_setup, steps: scene.steps(), up, expected_tip })
}

/// Builds the simulation of a scene of the engine that a user has changed, on the shape of the former one if its mesh has not changed.
#[cfg(feature = "viewer")]
pub fn rebuild(
    scene: &Scene,
    shape: Option<&fem_model::simulation::Shape>,
    data: &std::path::Path,
) -> Result<Box<dyn Simulation>, String> {
    let body = match shape {
        Some(shape) => fem_scene::body_of_shape(scene, shape.clone(), data),
        None => fem_scene::body(scene, data),
    };
    engine::build(scene, body.map_err(|error| error.problem())?).map_err(|end| end.message())
}

/// Reads the meshes of a scene, with warnings of probable mistakes.
pub fn body(course: &Course, scene: &Scene) -> Result<Body, End> {
    let body = progress::during("reading the body", || fem_scene::body(scene, &course.data()));
    let body = body.map_err(End::unusable)?;
    for warning in fem_scene::warnings(scene, &body) {
        eprintln!("warning: {warning}");
    }
    for note in &body.notes {
        eprintln!("note: {}: {note}", scene.path.display());
    }
    let integrator = scene.time.integrator;
    // Methods that move nodes one by one support only a lumped mass.
    if body.lumped_mass && scene.mass.lumped.is_none() && !integrator.needs_node_masses() {
        eprintln!(
            "note: {} lumps the mass of so large a body at its nodes; mass.lumped = false keeps it consistent",
            integrator.name()
        );
    }
    Ok(body)
}

/// Warns of display vertices that the mesh does not enclose: their weights stretch them.
fn warn_of_vertices_outside(scene: &Scene, simulation: &dyn Simulation) {
    let outside = simulation.display_vertices_outside();
    if outside > 0 {
        eprintln!(
            "warning: {}: mesh.display: {outside} vertices lie outside the tetrahedra and follow the nearest one; \
             use a cage that encloses the surface",
            scene.path.display()
        );
    }
}
