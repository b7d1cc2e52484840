//! Changes of a scene while its simulation runs.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use fem_scene::Scene;
use fem_scene::simulation::{Parameter, Simulation};
use nalgebra::Vector3;

use crate::options::{Builder, Editing};
use crate::panics::panic_message;
use crate::scene_parameters::{self, Change};

/// A scene, and what builds its simulation anew.
pub struct SceneEditor {
    scene: Scene,
    /// The scene before all changes.
    initial: Scene,
    builder: Builder,
    up: Vector3<f64>,
}

/// The fate of the state of a simulation that was built anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// It goes on: positions, velocities and internal variables were carried over.
    GoesOn,
    /// It starts again, on another mesh.
    StartsAgain,
}

impl SceneEditor {
    /// An editor that has changed nothing; `up` is against the direction that gravity has if the scene gives it none.
    pub fn new(editing: Editing, up: Vector3<f64>) -> Self {
        let Editing { scene, builder, .. } = editing;
        SceneEditor { initial: scene.clone(), scene, builder, up }
    }

    /// The scene with all changes.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The numbers that can be changed.
    pub fn parameters(&self) -> Vec<Parameter> {
        scene_parameters::parameters(&self.scene, &self.initial)
    }

    /// The picture of the body, if it is made from one.
    pub fn object(&self) -> Option<PathBuf> {
        scene_parameters::object(&self.scene)
    }

    /// Changes the scene and replaces its simulation. Integrator and parameters of the former one stay, and so does its state if the
    /// mesh stays. After an error scene and simulation are as they were.
    pub fn apply(&mut self, changes: &[Change], simulation: &mut Box<dyn Simulation>) -> Result<Motion, String> {
        let mut scene = self.scene.clone();
        for change in changes {
            let overrides = scene_parameters::overrides(&scene, change, &self.up)?;
            scene = scene.changed(&overrides).map_err(|error| error.problem())?;
        }
        let keeps_mesh = scene.mesh == self.scene.mesh;
        let shape = keeps_mesh.then(|| simulation.shape());
        let built = catch_unwind(AssertUnwindSafe(|| self.builder.build(&scene, shape.as_deref())));
        let mut next =
            built.unwrap_or_else(|panic| Err(format!("the program has a fault: {}", panic_message(&*panic))))?;
        take_over_method(&**simulation, &mut *next);
        let motion = match keeps_mesh {
            true => next.restore(&simulation.checkpoint()).map(|()| Motion::GoesOn).unwrap_or(Motion::StartsAgain),
            false => Motion::StartsAgain,
        };
        // After the state, because a parameter that is set drops what was derived from earlier states and other numbers.
        for parameter in simulation.parameters() {
            let _ = next.set_parameter(parameter.key, parameter.value); // one that the new simulation refuses keeps its own value
        }
        *simulation = next;
        self.scene = scene;
        Ok(motion)
    }
}

/// Goes on to the integrator that the user has chosen.
fn take_over_method(from: &dyn Simulation, to: &mut dyn Simulation) {
    let first = to.integrator();
    while to.integrator() != from.integrator() {
        if to.next_integrator() == first {
            return; // it does not have it
        }
    }
}
