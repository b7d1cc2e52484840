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

/// `[material]`: C and D, or Young's modulus and Poisson's ratio.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Which law.
    pub model: Model,
    /// Neo-Hookean C, Pa.
    #[serde(rename = "C")]
    pub c: Option<f64>,
    /// Neo-Hookean D, Pa.
    #[serde(rename = "D")]
    pub d: Option<f64>,
    /// Young's modulus, Pa.
    pub young: Option<f64>,
    /// Poisson's ratio.
    pub poisson: Option<f64>,
    /// Density, kg/m³.
    pub density: f64,
}

impl Material {
    /// C and D, Pa: as given, or those with the same small-strain moduli as `young` and `poisson`,
    /// C = E/(4(1+ν)) and D = E/(6(1−2ν)).
    pub fn neo_hookean(&self) -> Option<(f64, f64)> {
        match (self.c, self.d, self.young, self.poisson) {
            (Some(C), Some(D), _, _) => Some((C, D)),
            (_, _, Some(E), Some(nu)) => Some((E / (4.0 * (1.0 + nu)), E / (6.0 * (1.0 - 2.0 * nu)))),
            _ => None,
        }
    }
}

/// Constitutive law.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)] // the names are the field's
pub enum Model {
    Linear,
    Corotated,
    StVenantKirchhoff,
    NeoHookean,
    StableNeoHookean,
}

impl Model {
    /// The name as scene files spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Corotated => "corotated",
            Self::StVenantKirchhoff => "st_venant_kirchhoff",
            Self::NeoHookean => "neo_hookean",
            Self::StableNeoHookean => "stable_neo_hookean",
        }
    }
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
