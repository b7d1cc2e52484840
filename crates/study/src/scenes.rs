//! Bodies and simulations of scenes in memory.

use std::fmt;
use std::path::Path;

use fem_engine::simulator::{Compiled, Simulator, build};
use fem_model::simulation::Simulation;
use fem_model::{Body, BodyMesh};
use fem_scene::{Scene, SceneError, body, body_of, parse};

/// The elements of a body, and the form of their volume energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Elements {
    /// Order of the shape functions.
    pub order: usize,
    /// Value of `material.volumetric`.
    pub volumetric: &'static str,
}

/// The elements of a scene that names none.
pub const LINEAR: Elements = Elements { order: 1, volumetric: "standard" };

/// Quadratic ones with the energy of their law.
pub const QUADRATIC: Elements = Elements { order: 2, volumetric: "standard" };

/// Elements that do not lock near ν = ½, or hardly.
pub const WITHOUT_LOCKING: [Elements; 5] =
    [LINEAR.with("averaged"), LINEAR.with("mixed"), QUADRATIC, QUADRATIC.with("averaged"), QUADRATIC.with("mixed")];

impl Elements {
    /// The same elements with another form of their volume energy.
    pub const fn with(self, volumetric: &'static str) -> Self {
        Self { volumetric, ..self }
    }

    /// The lines of `[mesh]` and `[material]` that name them, none for those of a scene that names none.
    pub fn keys(self) -> [String; 2] {
        let order = if self.order == 1 { String::new() } else { format!("order = {}\n", self.order) };
        let volumetric = match self.volumetric {
            "standard" => String::new(),
            form => format!("volumetric = \"{form}\"\n"),
        };
        [order, volumetric]
    }
}

impl fmt::Display for Elements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let order = if self.order == 1 { "linear" } else { "quadratic" };
        match self.volumetric {
            "standard" => write!(f, "{order} elements"),
            form => write!(f, "{order} elements, {form}"),
        }
    }
}

/// `[mesh]` of a scene whose mesh another one replaces.
pub const REPLACED: &str = "box = { size = [1, 1, 1], cells_per_unit = 1 }";

/// The same of a flat body.
pub const REPLACED_FLAT: &str = "rectangle = { size = [1, 1], cells_per_unit = 1 }";

/// The text of a scene for the engine: its mesh, material and time, and further tables.
pub fn text(mesh: &str, material: &str, time: &str, tables: &str) -> String {
    format!("pipeline = \"engine\"\n[mesh]\n{mesh}\n[material]\n{material}\n[time]\n{time}\n{tables}")
}

/// The scene of a text and its body; `mesh` takes the place of the scene's own.
pub fn scene_and_body(text: &str, mesh: Option<BodyMesh>) -> Result<(Scene, Body), SceneError> {
    let scene = parse(text, Path::new("case.toml"))?;
    let body = match mesh {
        Some(mesh) => body_of(&scene, mesh, Path::new(""))?,
        None => body(&scene, Path::new(""))?,
    };
    Ok((scene, body))
}

/// The simulator of a text, in the precision that the text names.
pub fn simulator<T: Compiled>(text: &str, mesh: Option<BodyMesh>) -> Result<Simulator<T>, SceneError> {
    let (scene, body) = scene_and_body(text, mesh)?;
    Simulator::new(body, &scene.method()).map_err(|refusal| scene.refused(refusal))
}

/// The simulation of a text in double precision.
pub fn double(text: &str, mesh: Option<BodyMesh>) -> Result<Simulator<f64>, String> {
    simulator(text, mesh).map_err(|error| error.to_string())
}

/// The simulation of a text on a mesh in memory, in any precision.
pub fn simulation(text: &str, mesh: impl Into<BodyMesh>) -> Result<Box<dyn Simulation>, String> {
    let (scene, body) = scene_and_body(text, Some(mesh.into())).map_err(|error| error.to_string())?;
    build(body, &scene.method()).map_err(|refusal| scene.refused(refusal).to_string())
}

/// Advances by one step, which must converge.
pub fn step(simulation: &mut dyn Simulation) -> Result<(), String> {
    simulation.step().map_err(|failure| failure.to_string())?;
    match simulation.counters().unconverged_steps {
        0 => Ok(()),
        _ => Err(format!("step {} has not converged", simulation.steps())),
    }
}

/// Advances by a number of steps, each of which must converge.
pub fn steps(simulation: &mut dyn Simulation, count: usize) -> Result<(), String> {
    (0..count).try_for_each(|_| step(simulation))
}
