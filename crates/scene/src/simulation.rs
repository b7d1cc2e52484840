//! The one trait between a pipeline and whoever drives it.

use std::fmt;
use std::sync::Arc;

use nalgebra::{DVector, Matrix3, Matrix4, Vector3, Vector4};

use fem_mesh::{SurfaceMesh, TetrahedralMesh};

/// A body in motion, as the window, the headless loop and the reports see it. Lengths in m, times in s, energies in J.
pub trait Simulation: Send {
    /// The scene's name, for titles and statistics.
    fn name(&self) -> &str;

    /// The undeformed mesh and surfaces; they never change in a run.
    fn shape(&self) -> Arc<Shape>;

    /// `q  (3n)` positions of all nodes now, m.
    fn positions(&self) -> DVector<f64>;

    /// `qdot  (3n)` velocities of all nodes now, m/s.
    fn velocities(&self) -> DVector<f64>;

    /// Positions of the display surface's vertices now, m: skinned where the scene has a display mesh, else the nodes.
    fn display_positions(&self) -> Vec<Vector3<f64>>;

    /// Seconds simulated since the start or the last reset.
    fn time(&self) -> f64;

    /// Seconds that one step advances.
    fn dt(&self) -> f64;

    /// Advances by one time step. After a failure the state is the last good one; only [`reset`](Self::reset) goes on.
    fn step(&mut self) -> Result<(), Failure>;

    /// Back to the start: rest positions, no velocity, time zero. Parameters and integrator stay as they are set.
    fn reset(&mut self);

    /// Kinetic and potential energy now.
    fn energies(&self) -> Energies;

    /// Smallest J = det F of all elements now, and the element that has it.
    fn min_J(&self) -> (f64, usize);

    /// Cauchy stress of each element now, Pa.
    fn stresses(&self) -> Vec<Matrix3<f64>>;

    /// Name of the integrator in use, as scene files spell it.
    fn integrator(&self) -> &'static str;

    /// Goes on with the next integrator that this pipeline has, and returns its name.
    fn next_integrator(&mut self) -> &'static str;

    /// What a person may change while it runs.
    fn parameters(&self) -> Vec<Parameter>;

    /// Sets one of [`parameters`](Self::parameters) by its key; refuses values that are not finite or out of range.
    fn set_parameter(&mut self, key: &str, value: f64) -> Result<(), String>;

    /// Nodes near the point of the body under a click; empty where the click misses.
    fn pick(&self, click: &Click) -> Vec<usize>;

    /// Springs that a person holds: replaces the scene's scripted drag until `None` is given.
    fn pull(&mut self, pull: Option<Pull>);

    /// The forces with which `[fixed]` and each `[[prescribed]]` hold the body now; none where a pipeline does not know them.
    fn reactions(&self) -> Vec<Reaction> {
        Vec::new()
    }

    /// Counts of the work done since the start (a reset does not clear them).
    fn counters(&self) -> Counters;

    /// What the scene builds and what it leaves out.
    fn parts(&self) -> Vec<Part>;
}

/// The undeformed body.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Nodes and tetrahedra that are simulated.
    pub mesh: TetrahedralMesh,
    /// Boundary triangles of `mesh`, as indices of its nodes, counter-clockwise from outside.
    pub boundary: Vec<[usize; 3]>,
    /// Surface that is shown, where the scene names one.
    pub display: Option<SurfaceMesh>,
}

/// Energies of the whole body, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// ½ vᵀ M v
    pub kinetic: f64,
    /// Elastic energy, gravity, dead loads and springs, and pressures that have a potential: those whose surface is closed or
    /// has a fixed edge.
    pub potential: f64,
}

impl Energies {
    /// Kinetic and potential energy together.
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }
}

/// What holds a part of the body, and how hard.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// The scene's table: `fixed`, or such as `prescribed[0]`.
    pub name: String,
    /// Sum over the nodes of the force on the body, in the directions that are held, N.
    pub force: [f64; 3],
}

/// A number that a person may change while the simulation runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name for [`Simulation::set_parameter`].
    pub key: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// SI unit, such as `Pa`.
    pub unit: &'static str,
    /// Value in use.
    pub value: f64,
    /// Smallest and largest value that is accepted.
    pub range: (f64, f64),
    /// Whether a slider should be logarithmic.
    pub logarithmic: bool,
}

/// A click into a picture of the simulation mesh, in OpenGL's conventions.
#[derive(Clone, Debug, PartialEq)]
pub struct Click {
    /// Pixels from the lower left; z is not used.
    pub win: Vector3<f64>,
    /// World to eye.
    pub view: Matrix4<f32>,
    /// Eye to clip, depth −1…1.
    pub proj: Matrix4<f32>,
    /// `(x, y, width, height)` in pixels.
    pub viewport: Vector4<f32>,
}

/// Zero-length springs from each of some nodes to where the node was when the pull began, plus a common offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Pull {
    /// Nodes that are held, and where each was when the pull began, m.
    pub anchors: Vec<(usize, Vector3<f64>)>,
    /// How far the hand has moved since, m.
    pub offset: Vector3<f64>,
}

/// Work done so far. Each field counts what its name says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)] // the names are the documentation; they are the keys of the statistics file
pub struct Counters {
    pub steps: usize,
    pub newton_iterations: usize,
    pub unconverged_steps: usize,
    pub factorizations: usize,
    pub symbolic_factorizations: usize,
    pub solver_iterations: usize,
    pub force_assemblies: usize,
    pub stiffness_assemblies: usize,
    pub energy_evaluations: usize,
    pub line_search_backtracks: usize,
    pub projections: usize,
    pub skinning_rows: usize,
}

/// One part of a scene: built, or left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Short name, also its key in the statistics file.
    pub name: &'static str,
    /// Whether the scene builds it.
    pub built: bool,
    /// What it is for and what in the scene switches it on or leaves it out.
    pub why: String,
    /// Memory that it holds, bytes.
    pub bytes: usize,
    /// How often it has been used so far.
    pub uses: usize,
    /// Wall-clock time spent in it so far, s.
    pub seconds: f64,
}

/// Why a simulation cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The step that failed, counted from 1 since the start or the last reset.
    pub step: usize,
    /// The time that the step would have reached, s.
    pub time: f64,
    /// What happened.
    pub cause: Cause,
    /// What a person can do about it.
    pub remedy: String,
}

/// What ended a simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// A position or velocity is NaN or infinite.
    NotFinite {
        /// The first node that is.
        node: usize,
    },
    /// An element is turned inside out or has no volume left.
    Inverted {
        /// The element.
        element: usize,
        /// Its J = det F ≤ 0.
        J: f64,
    },
    /// Where a step starts, an energy or a force is too large for a number.
    Overflow,
    /// A linear system was not solved.
    Solver(Breakdown),
    /// Newton's method found no velocity of lower energy, though forces are not in balance.
    Stuck {
        /// The largest component of what is left of the forces, N.
        unbalanced: f64,
    },
}

/// Why a linear system was not solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Breakdown {
    /// The matrix is not positive definite: a pivot, or the curvature along a search direction, is not positive.
    NotPositiveDefinite,
    /// The matrix is singular, or holds a number that is not finite.
    Singular,
    /// The iteration ended before it reached its tolerance.
    NotConverged {
        /// Relative residual that was reached.
        residual: f64,
    },
    /// The factor would not fit into memory.
    TooLarge,
}

impl fmt::Display for Breakdown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositiveDefinite => write!(f, "the stiffness is not positive definite"),
            Self::Singular => write!(f, "the stiffness is singular, or not finite"),
            Self::NotConverged { residual } => {
                write!(f, "the linear solver does not converge (relative residual {residual:.1e})")
            }
            Self::TooLarge => write!(f, "the factor of the stiffness does not fit into memory"),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the simulation failed in step {} (t = {:.6} s): ", self.step, self.time)?;
        match self.cause {
            Cause::NotFinite { node } => write!(f, "node {node} is no longer at a finite place")?,
            Cause::Inverted { element, J } => write!(f, "element {element} is inverted (J = {J:.3e})")?,
            Cause::Overflow => write!(f, "an energy or a force is too large for a number")?,
            Cause::Solver(breakdown) => write!(f, "{breakdown}")?,
            Cause::Stuck { unbalanced } => write!(
                f,
                "Newton's method finds no way to lower the energy, and {unbalanced:.3e} N are not in balance"
            )?,
        }
        write!(f, "; {}", self.remedy)
    }
}

impl std::error::Error for Failure {}
