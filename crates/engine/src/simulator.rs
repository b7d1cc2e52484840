//! The engine's simulation of one scene: what drives [`System`] and [`State`] as a [`Simulation`].

mod build;
mod parts;
mod range;
mod reactions;
mod rigid;
mod simulation;
mod stepper;

use crate::forces::pulls::AnchorSpring;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use crate::profile::Timer;
use crate::skinning::Skinning;
use crate::solvers::SolverChoice;
use fem_scene::simulation::{Counters, Pull, Simulation};
use fem_scene::{Body, Integrator, Material, Method, Precision, Scene, SceneError};
use stepper::Stepper;

pub use build::integrators;

/// The field of a scene that cannot be simulated, and the problem with its remedy.
type Refusal = (&'static str, String);

/// A body that the engine moves, in one float type.
pub struct Simulator<T: Real> {
    method: Method,
    /// The scene's `[material]`.
    material: Material,
    lumped_mass: bool,
    system: System<T>,
    state: State<T>,
    /// Where a step that fails returns to.
    last_good: State<T>,
    stepper: Stepper<T>,
    integrator: Integrator,
    choice: SolverChoice,
    dt: f64,
    skinning: Option<Skinning>,
    /// Stiffness of every pull, N/m.
    drag_stiffness: f64,
    /// A person's pull, which takes the place of the scene's.
    pull: Option<Pull>,
    springs: Vec<AnchorSpring<T>>,
    counters: Counters,
    /// Display vertices that were computed; pictures are asked for through `&self`.
    skinned_rows: std::sync::atomic::AtomicUsize,
    /// Display surfaces and reactions that somebody has asked for.
    skinned: Timer,
    reacted: Timer,
}

impl<T: Real> Simulator<T> {
    /// What never changes.
    pub fn system(&self) -> &System<T> {
        &self.system
    }

    /// Where the body is, in the engine's order of nodes.
    pub fn state(&self) -> &State<T> {
        &self.state
    }

    /// Puts the nodes anywhere: displacements from rest (m) and velocities (m/s), in the mesh's order. Time goes on as it is.
    pub fn place(&mut self, displacements: &[[f64; 3]], velocities: &[[f64; 3]]) {
        for (node, &mesh_node) in self.system.order.mesh_node.iter().enumerate() {
            self.state.u[node] = displacements[mesh_node as usize].map(T::of);
            self.state.v[node] = velocities[mesh_node as usize].map(T::of);
        }
        self.stepper.forget();
    }
}

/// Builds what the scene names, in the precision that it names.
pub fn build(scene: &Scene, body: Body) -> Result<Box<dyn Simulation>, SceneError> {
    Ok(match scene.time.precision {
        Precision::F64 => Box::new(Simulator::<f64>::new(scene, body)?),
        Precision::F32 => Box::new(Simulator::<f32>::new(scene, body)?),
    })
}
