//! Scenes that the engine runs. It is not in this repository, since it holds solutions of the exercises.

use fem_mesh::TetrahedralMesh;
use fem_model::simulation::{Part, Simulation};
use fem_model::Body;
use fem_scene::Scene;
use nalgebra::Vector3;

use super::end::End;

/// Refuses: your own functions run the course's scenes.
pub fn build(scene: &Scene, _: Body) -> Result<Box<dyn Simulation>, End> {
    Err(refused(scene))
}

/// Refuses as [`build`] does.
pub fn planned_parts(scene: &Scene, _: &Body) -> Result<Vec<Part>, End> {
    Err(refused(scene))
}

/// Returns `None`: no scene of the course is a mass-spring body.
pub fn line_of_moduli(_: &Body) -> Result<Option<String>, End> {
    Ok(None)
}

fn refused(scene: &Scene) -> End {
    End::unusable(scene.refuse("pipeline", "is \"engine\", which this repository does not have; write \"course\""))
}

/// Returns `None`: no scene of the course has a closed form.
pub fn expected_tip_displacement(_: &Scene, _: &Body) -> Option<Vector3<f64>> {
    None
}

/// Prints no line: no scene of the course is a cantilever.
pub fn print_tip(_: &dyn Simulation, _: &Vector3<f64>) {}

/// Refuses: the engine assembles the stiffness.
pub fn print_conditioning(_: &TetrahedralMesh) -> Result<(), End> {
    Err(End::unusable("--stiffness needs the engine, which this repository does not have; leave it out".to_owned()))
}
