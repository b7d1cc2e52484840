//! Scenes that the fast engine runs: it is not in this repository, since it holds what you are to write.

use fem_engine::scene::{Body, Scene};
use fem_engine::simulation::Simulation;

use super::end::End;

/// Refuses: your own functions run the course's scenes.
pub fn build(scene: &Scene, _: Body) -> Result<Box<dyn Simulation>, End> {
    let problem = "is \"engine\", which this repository does not have; write \"course\"";
    Err(End::unusable(scene.refuse("pipeline", problem)))
}
