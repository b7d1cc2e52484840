//! Scene files: what a scene says, as plain data.
//!
//! The tables and keys are those of the file; one that a scene leaves out is `None` and is not built.
//! [`load`] reads and checks a file, [`body`] reads the meshes that it names.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

mod body;
pub mod cantilever;
mod check;
mod error;
mod integrator;
mod interaction;
mod load;
mod loads;
mod material;
mod methods;
mod motion;
mod nodes;
pub mod output;
pub mod simulate;
pub mod simulation;
mod timer;

pub use body::{Body, body, body_of};
pub use error::SceneError;
pub use integrator::Integrator;
pub use interaction::{Anchor, Interaction};
pub use load::{load, names, parse};
pub use loads::{BodyForce, Drag, DragVertex, Gravity, SidePlane, Spring, Traction};
pub use material::{MODELS, Material};
pub use methods::{Damping, Newton, Precision, Preconditioner, Projection, Solver, SolverKind, Static, Time};
pub use motion::{Fixed, Plane, Prescribed, Rotation};
pub use timer::Timer;

pub use fem_mesh::Side;

use std::path::PathBuf;

use serde::Deserialize;

/// A scene as its file tells it, checked; SI units.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name of the file without folder and extension.
    #[serde(skip)]
    pub name: String,
    /// The file.
    #[serde(skip)]
    pub path: PathBuf,
    /// One line about the scene.
    #[serde(default)]
    pub about: String,
    /// What runs it.
    pub pipeline: Pipeline,
    /// What it is made of.
    pub mesh: MeshTable,
    /// What that is made of.
    pub material: Material,
    /// Lumped or consistent mass.
    #[serde(default)]
    pub mass: Mass,
    /// Gravity.
    pub gravity: Option<Gravity>,
    /// A force on every piece of the body.
    pub body_force: Option<BodyForce>,
    /// Forces on parts of the surface.
    #[serde(default)]
    pub traction: Vec<Traction>,
    /// Springs between nodes.
    #[serde(default)]
    pub springs: Vec<Spring>,
    /// Nodes that never move.
    pub fixed: Option<Fixed>,
    /// Nodes that move as the scene says.
    #[serde(default)]
    pub prescribed: Vec<Prescribed>,
    /// Time steps.
    pub time: Time,
    /// Rayleigh damping.
    pub damping: Option<Damping>,
    /// Equilibrium.
    #[serde(rename = "static")]
    pub statics: Option<Static>,
    /// Newton's method of the engine.
    pub newton: Option<Newton>,
    /// Linear solver of the engine.
    pub solver: Option<Solver>,
    /// A scripted pull.
    pub drag: Option<Drag>,
}

/// What runs a scene.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Pipeline {
    /// The functions of the assignment.
    Course,
    /// The fast engine.
    Engine,
}

/// `[mesh]`: exactly one source of tetrahedra.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct MeshTable {
    /// A mesh file.
    pub file: Option<PathBuf>,
    /// A box.
    #[serde(rename = "box")]
    pub cuboid: Option<Cuboid>,
    /// A surface to show instead of the tetrahedra.
    pub display: Option<PathBuf>,
    /// Factor for all coordinates of both.
    #[serde(default = "one")]
    pub scale: f64,
    /// How often every tetrahedron is cut into eight.
    #[serde(default)]
    pub refine: u32,
}

fn one() -> f64 {
    1.0
}

/// A box from the origin, cut into cubes of six tetrahedra each.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    /// Edge lengths, m.
    #[serde(deserialize_with = "load::three_numbers")]
    pub size: [f64; 3],
    /// Cubes per metre.
    pub cells_per_unit: usize,
}

/// `[mass]`
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Mass {
    /// Whether the mass of each row is gathered on the diagonal.
    #[serde(default)]
    pub lumped: bool,
}

/// A coordinate axis; its number is the index of the coordinate.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)]
pub enum Axis {
    X,
    Y,
    Z,
}
