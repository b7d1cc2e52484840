//! Options of a window.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

use fem_model::simulation::{Shape, Simulation};
use fem_scene::Scene;
use fem_scene::output::ElementField;
use nalgebra::Vector3;

/// Builds the simulation of a scene. It is called on the simulation's thread.
#[derive(Clone)]
pub struct Builder(Arc<Build>);

/// The simulation of a scene, on a shape that was made for the same `[mesh]` if one is given; else a message with a remedy.
type Build = dyn Fn(&Scene, Option<&Shape>) -> Result<Box<dyn Simulation>, String> + Send + Sync;

impl Builder {
    /// A builder that calls `build` with a scene and, if its mesh has not changed, the shape of the former simulation.
    pub fn new(
        build: impl Fn(&Scene, Option<&Shape>) -> Result<Box<dyn Simulation>, String> + Send + Sync + 'static,
    ) -> Self {
        Builder(Arc::new(build))
    }

    pub(crate) fn build(&self, scene: &Scene, shape: Option<&Shape>) -> Result<Box<dyn Simulation>, String> {
        (self.0)(scene, shape)
    }
}

impl fmt::Debug for Builder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Builder")
    }
}

/// The scene of a simulation, which the panel of its window changes.
#[derive(Clone, Debug)]
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

/// Options of a window.
#[derive(Clone, Debug)]
pub struct WindowOptions {
    /// Width and height, logical pixels.
    pub size: (u32, u32),
    /// Upward direction in the picture.
    pub up: Vector3<f64>,
    /// The field that colours the elements at the start; `None` for plain colours.
    pub color: Option<ElementField>,
    /// Path of a PNG file of the window, written after the last step or when it closes.
    pub screenshot: Option<PathBuf>,
    /// Folder for recorded frames, [`FRAMES_PER_SECOND`](crate::FRAMES_PER_SECOND) of simulated time; the simulation then waits for each.
    pub record: Option<PathBuf>,
    /// Number of steps after which the window closes; it closes earlier if the simulation fails.
    pub quit_after_steps: Option<usize>,
    /// Keep the energies of every step for [`Outcome::energies`](crate::Outcome::energies).
    pub log_energies: bool,
    /// The scene, for a panel that changes it; `None` for one with the parameters of the simulation alone.
    pub editing: Option<Editing>,
    /// The window closes once this is not zero, such as after a signal.
    pub close: Arc<AtomicUsize>,
}

impl Default for WindowOptions {
    fn default() -> Self {
        WindowOptions {
            size: (1280, 800),
            up: Vector3::y(),
            color: None,
            screenshot: None,
            record: None,
            quit_after_steps: None,
            log_energies: false,
            editing: None,
            close: Arc::default(),
        }
    }
}
