//! The tables and keys of a scene file. A table that a scene leaves out is `None` and builds no part.

mod batch;
mod constraints;
mod contact;
mod curve;
mod fibres;
mod initial;
mod loads;
mod material;
mod method;
mod plasticity;
mod selector;
mod vectors;

pub use curve::{CurveTable, SineTable};

pub use batch::{BatchTable, RangeTable, Spacing, VaryTable};
pub use constraints::{FixedTable, PrescribedTable, RotationTable};
pub use contact::{ContactTable, PlaneTable};
pub use fibres::{AroundTable, FibresTable};
pub use initial::{AngularVelocityTable, InitialVelocityTable};
pub use loads::{BodyForceTable, DragTable, DragVertex, ForceTable, GravityTable, SpringTable, TractionTable};
pub use material::{MaterialTable, MaterialsTable};
pub use method::{
    AdaptiveTable, DampingTable, EnergyTable, GeneralizedAlphaTable, IterationsTable, NewmarkTable, NewtonTable,
    SolverTable, StaticTable, TimeTable,
};
pub use plasticity::{PlasticModel, PlasticityTable};
pub use selector::{BoxTable, On, Plane, SidePlane, SphereTable};

use std::path::PathBuf;
use std::sync::Arc;

use serde::Deserialize;

use crate::overrides::Override;
use fem_mesh::{Pattern, Side};
use fem_model::ForceFields;

/// The struct of all tables, with those of the force fields.
macro_rules! scene {
    ($($(#[$doc:meta])* $table:ident: $Field:ident,)*) => {
        /// A scene file, checked. Tables and keys have the names of the file, quantities are in SI units.
        #[derive(Clone, Debug, Deserialize, PartialEq)]
        #[serde(deny_unknown_fields)]
        pub struct Scene {
            /// Name of the file without folder and extension.
            #[serde(skip)]
            pub name: String,
            /// The file.
            #[serde(skip)]
            pub path: PathBuf,
            /// The text of the file.
            #[serde(skip)]
            pub text: Text,
            /// The keys and values as the file and the overrides give them.
            #[serde(skip)]
            pub source: toml::Table,
            /// The overrides.
            #[serde(skip)]
            pub overrides: Vec<Override>,
            /// One line about the scene.
            #[serde(default)]
            pub about: String,
            /// The implementation that simulates the scene.
            pub pipeline: Pipeline,
            /// `[mesh]`
            pub mesh: MeshTable,
            /// `[material]`
            pub material: MaterialTable,
            /// `[[materials]]`
            #[serde(default)]
            pub materials: Vec<MaterialsTable>,
            /// `[plasticity]`
            pub plasticity: Option<PlasticityTable>,
            /// `[[fibres]]`
            #[serde(default)]
            pub fibres: Vec<FibresTable>,
            /// `[mass]`
            #[serde(default)]
            pub mass: MassTable,
            /// `[gravity]`
            pub gravity: Option<GravityTable>,
            /// `[body_force]`
            pub body_force: Option<BodyForceTable>,
            /// `[[traction]]`
            #[serde(default)]
            pub traction: Vec<TractionTable>,
            /// `[[force]]`
            #[serde(default)]
            pub force: Vec<ForceTable>,
            $($(#[$doc])* pub $table: Option<fem_model::$Field>,)*
            /// `[[springs]]`
            #[serde(default)]
            pub springs: Vec<SpringTable>,
            /// `[fixed]`
            pub fixed: Option<FixedTable>,
            /// `[[prescribed]]`
            #[serde(default)]
            pub prescribed: Vec<PrescribedTable>,
            /// `[[initial_velocity]]`
            #[serde(default)]
            pub initial_velocity: Vec<InitialVelocityTable>,
            /// `[[planes]]`
            #[serde(default)]
            pub planes: Vec<PlaneTable>,
            /// `[contact]`
            pub contact: Option<ContactTable>,
            /// `[time]`
            pub time: TimeTable,
            /// `[damping]`
            pub damping: Option<DampingTable>,
            /// `[static]`
            #[serde(rename = "static")]
            pub statics: Option<StaticTable>,
            /// `[newmark]`
            pub newmark: Option<NewmarkTable>,
            /// `[generalized_alpha]`
            pub generalized_alpha: Option<GeneralizedAlphaTable>,
            /// `[iterations]`
            pub iterations: Option<IterationsTable>,
            /// `[newton]`
            pub newton: Option<NewtonTable>,
            /// `[solver]`
            pub solver: Option<SolverTable>,
            /// `[energy]`
            pub energy: Option<EnergyTable>,
            /// `[drag]`
            pub drag: Option<DragTable>,
            /// `[batch]`
            pub batch: Option<BatchTable>,
        }

        impl Scene {
            /// The force fields.
            pub fn fields(&self) -> ForceFields {
                ForceFields { $($table: self.$table.iter().cloned().collect()),* }
            }
        }
    };
}

fem_model::force_fields! { scene }

/// The text of a scene's file, in which problems have their lines. Any two are equal: scenes are compared by their values.
#[derive(Clone, Debug, Default)]
pub struct Text(pub Arc<str>);

impl PartialEq for Text {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The code that simulates a scene.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Pipeline {
    /// The 22 functions of the course. It has the integrators `linearly_implicit_euler` and `implicit_euler` and the law `neo_hookean`.
    Course,
    /// The engine, which has every key.
    Engine,
}

/// `[mesh]`: the elements of the body. Exactly one of `file`, `files`, `box`, `surface`, `picture` and `rectangle` is their source.
///
/// Paths are those of files beside the scene or in `data`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct MeshTable {
    /// A file of tetrahedra, or of the triangles of a flat body: `.node` with `.ele`, `.mesh` (Medit), `.msh` (Gmsh 2 and 4, text and
    /// binary), `.vtu` or `.vtk`, each also compressed as `.gz`.
    pub file: Option<PathBuf>,
    /// Several such files, at least one: the bodies of one scene. All tetrahedra of a file are a set of the file's name without its
    /// extension. Bodies do not touch each other, unless `[[springs]]` connect them.
    pub files: Option<Vec<PathBuf>>,
    /// A box that is cut into tetrahedra.
    #[serde(rename = "box")]
    pub cuboid: Option<Cuboid>,
    /// The inside of a surface, filled with tetrahedra when the scene is loaded.
    pub surface: Option<SurfaceTable>,
    /// A flat body: the region of a picture, filled with triangles when the scene is loaded, as `mesh from-picture` does. Engine only.
    pub picture: Option<PictureTable>,
    /// A flat body: a rectangle that is cut into triangles. Engine only.
    pub rectangle: Option<RectangleTable>,
    /// A surface (`.obj`, `.ply`, `.stl`) that is drawn in place of the boundary of the tetrahedra and follows their motion; not with a
    /// flat body. Default: none, the boundary is drawn.
    pub display: Option<PathBuf>,
    /// Factor on all coordinates of the elements and of the display surface; positive.
    #[serde(default = "one")]
    pub scale: f64,
    /// Number of uniform refinements, 0 to 4. Each of them cuts every tetrahedron into eight, or every triangle of a flat body into four.
    /// Engine only.
    #[serde(default)]
    pub refine: u32,
    /// Polynomial order of the elements: 1, or 2 for quadratic tetrahedra, and for quadratic triangles of a flat body, which have a node on
    /// the middle of every edge. Corners keep their numbers. Engine only.
    #[serde(default = "first")]
    pub order: u32,
}

fn one() -> f64 {
    1.0
}

fn first() -> u32 {
    1
}

/// `box`: a box from the origin, cut into cubes of six tetrahedra each.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    /// Edge lengths, m.
    #[serde(deserialize_with = "vectors::three_numbers")]
    pub size: [f64; 3],
    /// Number of cubes per metre.
    pub cells_per_unit: usize,
    /// How the cubes are cut.
    #[serde(default)]
    pub pattern: Pattern,
}

/// `picture`: the region of a picture, filled with triangles.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PictureTable {
    /// A PNG or JPEG file.
    pub file: PathBuf,
    /// Height of the region, m unless `scale` changes it; positive.
    #[serde(default = "one")]
    pub height: f64,
    /// Mean edge of the triangles, in the unit of `height`.
    pub edge: f64,
    /// Number of iterations of optimal Delaunay triangulation, which improve the shapes of the triangles.
    #[serde(default = "five")]
    pub improve: usize,
}

fn five() -> usize {
    5
}

/// `rectangle`: a rectangle in the plane z = 0 from the origin, cut into squares of two triangles each.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct RectangleTable {
    /// Edge lengths, m.
    pub size: [f64; 2],
    /// Number of squares per metre.
    pub cells_per_unit: usize,
    /// How the squares are cut.
    #[serde(default)]
    pub pattern: Pattern,
}

/// `surface`: the inside of a surface, filled with tetrahedra.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SurfaceTable {
    /// A file of triangles: `.obj`, `.ply` or `.stl`.
    pub file: PathBuf,
    /// Mean edge of the tetrahedra in the file's unit of length, m unless `scale` changes it.
    pub edge: f64,
    /// Number of times that the edges may double in length towards the inside.
    #[serde(default)]
    pub grading: usize,
    /// Number of passes of improvement, in which the nodes of the boundary slide on the surface.
    #[serde(default)]
    pub improve: usize,
}

/// `[mass]`: the mass matrix. Engine only.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct MassTable {
    /// True if the mass is lumped at the nodes: each row of the mass matrix is summed on the diagonal. Default: `true` for `pbd`, `xpbd`
    /// and `vbd`, and for explicit methods with more than 2000 nodes or with obstacles.
    pub lumped: Option<bool>,
}
