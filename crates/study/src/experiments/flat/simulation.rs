//! Simulations of scenes in memory.

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_model::BodyMesh;
use fem_model::simulation::Simulation;
use fem_scene::{body, body_of, parse};

/// The simulation of a scene; `mesh` takes the place of the scene's `[mesh]`.
pub fn simulation(text: &str, mesh: Option<BodyMesh>) -> Result<Simulator<f64>, String> {
    let scene = parse(text, Path::new("flat.toml")).map_err(|error| error.to_string())?;
    let body = match mesh {
        Some(mesh) => body_of(&scene, mesh, Path::new("")),
        None => body(&scene, Path::new("")),
    };
    let body = body.map_err(|error| error.to_string())?;
    Simulator::new(body, &scene.method()).map_err(|refusal| scene.refused(refusal).to_string())
}

/// Advances by one step, which must converge.
pub fn step(simulation: &mut Simulator<f64>) -> Result<(), String> {
    simulation.step().map_err(|failure| failure.to_string())?;
    match simulation.counters().unconverged_steps {
        0 => Ok(()),
        _ => Err(format!("step {} has not converged", simulation.steps())),
    }
}

/// Advances by a number of steps, each of which must converge.
pub fn steps(simulation: &mut Simulator<f64>, count: usize) -> Result<(), String> {
    (0..count).try_for_each(|_| step(simulation))
}
