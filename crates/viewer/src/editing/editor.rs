//! Changes of a scene while its simulation runs.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fem_model::Integrator;
use fem_model::simulation::{Parameter, Shape, Simulation};
use fem_scene::{Conditions, Override, Scene};
use nalgebra::Vector3;

use super::change::{Change, Effect};
use super::tables::{TableOffer, offers};
use super::{edits, parameters};
use crate::panics::panic_message;

/// Builds the simulation of a scene, on a shape that was made for the same `[mesh]` if one is given; else returns a message with a remedy. It is
/// called on the simulation's thread.
pub type Builder = Arc<dyn Fn(&Scene, Option<&Shape>) -> Result<Box<dyn Simulation>, String> + Send + Sync>;

/// The scene of a simulation, which the panel of its window changes.
#[derive(Clone)]
pub struct Editing {
    /// The scene.
    pub scene: Scene,
    /// Pictures that the body can be made from in place of its own; they lie in one folder.
    pub objects: Vec<PathBuf>,
    /// The folder of scenes and meshes, in which a saved scene finds files.
    pub data: PathBuf,
    /// Builds the changed scene.
    pub builder: Builder,
}

/// A scene, and the builder of its simulation.
pub struct SceneEditor {
    scene: Scene,
    /// The scene before all changes.
    initial: Scene,
    builder: Builder,
    data: PathBuf,
    up: Vector3<f64>,
    setup: Option<Arc<SceneSetup>>,
}

/// A scene, the parts of the body that its conditions and loads name, and the tables that it can be given or lose.
#[derive(Clone, Debug)]
pub struct SceneSetup {
    /// The scene with the changes of its user.
    pub scene: Scene,
    /// The nodes and faces that it names.
    pub conditions: Conditions,
    /// The tables that its checks let the panel add and remove.
    pub offers: Vec<TableOffer>,
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
        let Editing { scene, builder, data, .. } = editing;
        SceneEditor { initial: scene.clone(), scene, builder, data, up, setup: None }
    }

    /// Finds the nodes and faces that the scene names on the body of its simulation, and the tables that can be added and removed.
    pub fn find_conditions(&mut self, simulation: &dyn Simulation) {
        let Self { scene, initial, up, .. } = &*self;
        let shape = simulation.shape();
        let offers = offers(scene, initial, &shape, up);
        let conditions = Conditions::of(scene, &shape).ok();
        self.setup = conditions.map(|conditions| Arc::new(SceneSetup { scene: scene.clone(), conditions, offers }));
    }

    /// The scene and the parts of the body that it names.
    pub fn setup(&self) -> Option<Arc<SceneSetup>> {
        self.setup.clone()
    }

    /// Writes the scene, with the method and the parameters that the simulation has now, to a new file.
    pub fn save(&self, path: &Path, simulation: &dyn Simulation) -> Result<(), String> {
        let scene = self.scene_of(simulation)?;
        fem_scene::save(&scene, path, &self.data).map_err(|error| error.to_string())
    }

    /// The scene with the integrator and the parameters of its simulation.
    pub fn scene_of(&self, simulation: &dyn Simulation) -> Result<Scene, String> {
        let mut scene = self.scene.clone();
        let nodes = simulation.shape().mesh.vertices().len();
        let was_lumped = scene.lumps_mass(nodes);
        if let Some(kind) = Integrator::from_name(simulation.integrator()).filter(|kind| *kind != scene.time.integrator)
        {
            scene = changed(&scene, &edits::integrator(&scene, kind).overrides)?;
        }
        let mut overrides = Vec::new();
        // The mass stays as it was built when a running simulation goes on with another integrator.
        if scene.lumps_mass(nodes) != was_lumped {
            overrides.push(Override::to("mass.lumped", was_lumped));
        }
        if simulation.dt() != scene.time.dt() {
            overrides.push(Override::to("time.dt", simulation.dt()));
        }
        if simulation.substeps() != scene.method().substeps {
            overrides.push(Override::to("time.substeps", simulation.substeps()));
        }
        let stiffness = simulation.parameters().into_iter().find(|parameter| parameter.key == "drag");
        if let (Some(drag), Some(now)) = (&scene.drag, stiffness)
            && drag.stiffness != now.value
        {
            overrides.push(Override::to("drag.stiffness", now.value));
        }
        changed(&scene, &overrides)
    }

    /// The scene with all changes.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The numbers that can be changed.
    pub fn parameters(&self) -> Vec<Parameter> {
        parameters::parameters(&self.scene, &self.initial)
    }

    /// The picture of the body, if it is made from one.
    pub fn object(&self) -> Option<PathBuf> {
        parameters::object(&self.scene)
    }

    /// Changes the scene and replaces its simulation. Integrator and parameters of the former one stay unless they are changed, and so does
    /// its state if mesh and Dirichlet conditions stay. After an error scene and simulation are as they were.
    pub fn apply(&mut self, changes: &[Change], simulation: &mut Box<dyn Simulation>) -> Result<Motion, String> {
        let mut scene = self.scene.clone();
        for change in changes {
            scene = changed(&scene, &parameters::overrides(&scene, change, &self.up)?)?;
        }
        let keeps_mesh = scene.mesh == self.scene.mesh;
        check_lists(&self.scene, &scene)?;
        let shape = keeps_mesh.then(|| simulation.shape());
        let built = catch_unwind(AssertUnwindSafe(|| (self.builder)(&scene, shape.as_deref())));
        let mut next =
            built.unwrap_or_else(|panic| Err(format!("the program has a fault: {}", panic_message(&*panic))))?;
        let has = |effect| changes.iter().any(|change| matches!(change, Change::Edit(edit) if edit.effect == effect));
        if !has(Effect::Method) {
            take_over_method(&**simulation, &mut *next);
        }
        let motion = match keeps_mesh && !has(Effect::Supports) {
            true => next.restore(&simulation.checkpoint()).map(|()| Motion::GoesOn).unwrap_or(Motion::StartsAgain),
            false => Motion::StartsAgain,
        };
        take_over_parameters(&**simulation, &mut *next);
        *simulation = next;
        self.scene = scene;
        Ok(motion)
    }
}

fn changed(scene: &Scene, overrides: &[Override]) -> Result<Scene, String> {
    scene.changed(overrides).map_err(|error| error.problem())
}

/// Refuses another mesh for a scene that lists nodes or faces by their numbers, which have no meaning there.
fn check_lists(before: &Scene, scene: &Scene) -> Result<(), String> {
    let mut mesh = before.mesh.clone();
    mesh.scale = scene.mesh.scale; // keeps the numbers
    let has_nodes = scene.fixed.iter().any(|table| table.nodes.is_some())
        || scene.prescribed.iter().any(|table| table.nodes.is_some());
    let has_faces = scene.traction.iter().any(|table| table.faces.is_some() || table.edges.is_some());
    if mesh == scene.mesh || !(has_nodes || has_faces) {
        return Ok(());
    }
    let (what, remedy) =
        if has_nodes { ("nodes", "erase the painted nodes") } else { ("faces", "remove the loads on picked faces") };
    Err(format!(
        "the scene lists {what} by their numbers in this mesh, which another mesh does not have; {remedy} first"
    ))
}

/// Gives a new simulation the parameters of the former one. The state comes before, because a parameter that is set drops what was derived
/// from earlier states and other numbers.
fn take_over_parameters(from: &dyn Simulation, to: &mut dyn Simulation) {
    let is_static = |simulation: &dyn Simulation| simulation.integrator() == Integrator::Static.name();
    let has_other_time = is_static(from) != is_static(to); // that of a static scene counts load steps
    for parameter in from.parameters().into_iter().filter(|parameter| parameter.key != "dt" || !has_other_time) {
        let _ = to.set_parameter(parameter.key, parameter.value); // one that the new simulation refuses keeps its own value
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
