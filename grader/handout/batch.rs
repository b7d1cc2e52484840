//! Runs of many environments. The engine runs them, which is not in this repository, since it holds solutions of the exercises.

use fem_scene::Scene;

use super::cli::RunArguments;
use super::end::End;

/// Refuses: your own functions run one body.
pub fn run(scene: &Scene, _: &RunArguments) -> Result<(), End> {
    Err(End::unusable(scene.refuse("batch", "belongs to the engine, which this repository does not have; remove it")))
}
