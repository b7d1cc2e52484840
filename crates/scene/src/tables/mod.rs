//! The tables and keys of a scene file. A table that a scene leaves out is `None` and builds no part.

mod constraints;
mod loads;
mod method;
mod vectors;

pub use constraints::{FixedTable, Plane, PrescribedTable, RotationTable};
pub use loads::{BodyForceTable, DragTable, DragVertex, GravityTable, SidePlane, SpringTable, TractionTable};
pub use method::{
    DampingTable, NewtonTable, Precision, Preconditioner, Projection, SolverKind, SolverTable, StaticTable, TimeTable,
};

use std::path::PathBuf;

use serde::Deserialize;

use crate::Material;
use fem_mesh::Side;

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
    pub mass: MassTable,
    /// Gravity.
    pub gravity: Option<GravityTable>,
    /// A force on every piece of the body.
    pub body_force: Option<BodyForceTable>,
    /// Forces on parts of the surface.
    #[serde(default)]
    pub traction: Vec<TractionTable>,
    /// Springs between nodes.
    #[serde(default)]
    pub springs: Vec<SpringTable>,
    /// Nodes that never move.
    pub fixed: Option<FixedTable>,
    /// Nodes that move as the scene says.
    #[serde(default)]
    pub prescribed: Vec<PrescribedTable>,
    /// Time steps.
    pub time: TimeTable,
    /// Rayleigh damping.
    pub damping: Option<DampingTable>,
    /// Equilibrium.
    #[serde(rename = "static")]
    pub statics: Option<StaticTable>,
    /// Newton's method of the engine.
    pub newton: Option<NewtonTable>,
    /// Linear solver of the engine.
    pub solver: Option<SolverTable>,
    /// A scripted pull.
    pub drag: Option<DragTable>,
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
    #[serde(deserialize_with = "vectors::three_numbers")]
    pub size: [f64; 3],
    /// Cubes per metre.
    pub cells_per_unit: usize,
}

/// `[mass]`
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct MassTable {
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
