//! Scenes that the fast engine runs.

use fem_engine::scene::{Body, Scene};
use fem_engine::simulation::Simulation;

use super::end::End;

/// The engine's simulation of a scene.
pub fn build(scene: &Scene, body: Body) -> Result<Box<dyn Simulation>, End> {
    fem_engine::engine::build(scene, body).map_err(End::unusable)
}
