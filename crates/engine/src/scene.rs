//! Scene files: what a scene says, as plain data.
//!
//! The tables and keys are those of the file; one that a scene leaves out is `None` and is not built.
//! [`load`] reads and checks a file, [`body`] reads the meshes that it names.

mod body;
mod check;
mod error;
mod integrator;
mod load;

pub use body::{Body, body};
pub use error::SceneError;
pub use integrator::Integrator;
pub use load::{load, names, parse};

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
    /// Nodes that never move.
    pub fixed: Option<Fixed>,
    /// Time steps.
    pub time: Time,
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

/// `[mass]`
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Mass {
    /// Whether the mass of each row is gathered on the diagonal.
    #[serde(default)]
    pub lumped: bool,
}

/// `[gravity]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// m/s²
    #[serde(deserialize_with = "load::three_numbers")]
    pub acceleration: [f64; 3],
}

/// `[fixed]`: nodes by a plane or by index.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// All nodes on one side of a plane.
    pub plane: Option<Plane>,
    /// These nodes.
    pub nodes: Option<Vec<usize>>,
}

/// All nodes whose coordinate is at most the mesh's smallest plus `below`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// Which coordinate.
    pub axis: Axis,
    /// Distance from the smallest coordinate of the mesh, m.
    pub below: f64,
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

/// `[time]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// Time step, s.
    pub dt: f64,
    /// Method that advances a step.
    pub integrator: Integrator,
    /// Steps of a run without a window.
    pub steps: Option<usize>,
}

/// `[newton]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Newton {
    /// Largest number of iterations in a step.
    pub max_iterations: Option<usize>,
    /// Relative tolerance on the velocity update.
    pub tolerance: Option<f64>,
}

/// `[solver]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// Which solver.
    pub kind: SolverKind,
    /// Relative residual of the iterative ones.
    pub tolerance: Option<f64>,
}

/// Linear solvers.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)] // the names are the field's
pub enum SolverKind {
    Cholesky,
    Lu,
    Cg,
    Pcg,
}

/// `[drag]`: a spring of no rest length from a vertex to a target that swings about where the vertex was at rest.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// The vertex that is pulled.
    pub vertex: DragVertex,
    /// N/m
    pub stiffness: f64,
    /// Taken as it is, not normalised.
    #[serde(deserialize_with = "load::three_numbers")]
    pub direction: [f64; 3],
    /// m
    pub amplitude: f64,
    /// Hz
    pub frequency: f64,
}

/// The vertex of a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DragVertex {
    /// The first vertex of largest y.
    Highest,
    /// This one.
    Index(usize),
}

impl<'de> Deserialize<'de> for DragVertex {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(load::DragVertexVisitor)
    }
}
