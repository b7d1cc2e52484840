//! The traits between a pipeline and the window, the headless loop and the reports.

mod checkpoint;
mod failure;
mod ledger;
mod parameter;
mod part;
mod picture_place;
mod plane;
mod plastic_flow;
mod pull;

use std::sync::Arc;

use nalgebra::{DVector, Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use fem_mesh::SurfaceMesh;

use crate::BodyMesh;
use crate::element::Element;

pub use checkpoint::{Checkpoint, History};
pub use failure::{Breakdown, Cause, Failure};
pub use ledger::{Energies, EnergyLedger};
pub use parameter::Parameter;
pub use part::Part;
pub use picture_place::PicturePlace;
pub use plane::{Plane, PlaneContact};
pub use plastic_flow::PlasticFlow;
pub use pull::{Click, Pull};

/// A simulation of one body, whichever pipeline computes it. Lengths are in m, times in s, energies in J.
pub trait Simulation: Interactive + Diagnostics + Send {
    /// The scene's name, for titles and statistics.
    fn name(&self) -> &str;

    /// The undeformed mesh and surfaces, which never change.
    fn shape(&self) -> Arc<Shape>;

    /// `q  (3n)` positions of all nodes now, m.
    fn positions(&self) -> DVector<f64>;

    /// `qdot  (3n)` velocities of all nodes now, m/s.
    fn velocities(&self) -> DVector<f64>;

    /// Positions of the display surface's vertices now, m: skinned if the scene has a display mesh, else the nodes.
    fn display_positions(&self) -> Vec<Vector3<f64>>;

    /// Simulated time since the start or the last reset, s.
    fn time(&self) -> f64;

    /// Steps since the start or the last reset.
    fn steps(&self) -> usize;

    /// Time step, s.
    fn dt(&self) -> f64;

    /// Advances by one time step. A step that fails leaves the state as it was before the substep that failed; after one that has gained
    /// energy ([`Cause::EnergyGained`]) it may be the state at its end.
    fn step(&mut self) -> Result<(), Failure>;

    /// Returns to the initial state: undeformed, at rest, time zero. Parameters and integrator keep their values.
    fn reset(&mut self);

    /// Everything that [`restore`](Self::restore) needs for the run to go on bit for bit as if it had not been interrupted.
    fn checkpoint(&self) -> Checkpoint;

    /// Takes over the state of a simulation of the same scene. Returns an error, and returns to the initial state, if the checkpoint
    /// is one of another body or method.
    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), String>;

    /// Kinetic and potential energy now, J.
    fn energies(&self) -> Energies;

    /// Minimum of J = det F over all elements now, and its element.
    fn min_J(&self) -> (f64, usize);

    /// Cauchy stress of each element now, Pa; empty where elements have none.
    fn stresses(&self) -> Vec<Matrix3<f64>>;

    /// Name of the integrator in use, as scene files spell it.
    fn integrator(&self) -> &'static str;

    /// Number of display vertices that lie in no tetrahedron.
    fn display_vertices_outside(&self) -> usize;

    /// `(3n)` sum of all forces on each node now, N: elastic, external and damping forces, and those of springs. It is M a at a
    /// free node, zero in equilibrium, and M a less the reaction at a constrained one. `None` for a pipeline that does not compute it.
    fn nodal_forces(&self) -> Option<DVector<f64>>;

    /// Work done since the start; a reset does not clear it.
    fn counters(&self) -> Counters;

    /// The parts that the scene builds and those that it leaves out.
    fn parts(&self) -> Vec<Part>;
}

/// What a user may change and touch while a simulation runs.
pub trait Interactive {
    /// Switches to the pipeline's next integrator, and returns its name.
    fn next_integrator(&mut self) -> &'static str;

    /// The numbers that the user may change while it runs.
    fn parameters(&self) -> Vec<Parameter>;

    /// Sets one of [`parameters`](Self::parameters) by its key.
    ///
    /// Returns an error if there is no such parameter, or if the value is not finite or out of its range.
    fn set_parameter(&mut self, key: &str, value: f64) -> Result<(), String> {
        let parameter = self.parameters().into_iter().find(|parameter| parameter.key == key);
        let parameter = parameter.ok_or_else(|| format!("there is no parameter {key}"))?;
        parameter.check(value)?;
        self.apply_parameter(parameter.key, value);
        Ok(())
    }

    /// Stores a value that [`set_parameter`](Self::set_parameter) has checked.
    fn apply_parameter(&mut self, key: &'static str, value: f64);

    /// Nodes near the point of the body under a click; empty if the click misses the body.
    fn pick(&self, click: &Click) -> Vec<usize>;

    /// Pulls at nodes in place of the scene's drag, until `None` is given.
    fn pull(&mut self, pull: Option<Pull>);
}

/// The findings of a pipeline about its run, beside the motion. A pipeline without them is [`Undiagnosed`].
pub trait Diagnostics {
    /// Number of equal substeps in which a step is computed.
    fn substeps(&self) -> usize;

    /// The account of the energy supplied, stored and dissipated; `None` in statics, and for a pipeline that does not compute it.
    fn energy_ledger(&self) -> Option<EnergyLedger>;

    /// The failure of a run that ends here and has not failed yet: energy gained that nothing explains, or a quadratic element inverted at a
    /// corner. Both are looked for every few steps, and a run may end between.
    fn failure_at_end(&self) -> Option<Failure>;

    /// Sum of the estimated errors of the displacements in the last step, m; `None` without adaptive steps.
    fn estimated_error(&self) -> Option<f64>;

    /// Part of the loads and prescribed motions that the load steps so far have applied; `None` for a motion.
    fn load_factor(&self) -> Option<f64>;

    /// Number of elements with det F ≤ 0 now; zero for a pipeline in which an inverted element ends the run.
    fn inverted_elements(&self) -> usize;

    /// The longest stable time step of an explicit method for small vibrations about the undeformed body, s: zero for a method that
    /// is unstable at any time step, `None` for implicit methods.
    fn critical_time_step(&self) -> Option<f64>;

    /// Returns true if elements have a stress: those of a mass-spring body have none.
    fn has_stress(&self) -> bool;

    /// Cauchy stress at each quadrature point now, Pa: those of the first element, then those of the next, as in
    /// [`BodyMesh::points`](crate::BodyMesh::points).
    fn stresses_at_points(&self) -> Vec<Matrix3<f64>>;

    /// The number of the material of each element; empty if all have the same.
    fn material_of_elements(&self) -> Vec<usize>;

    /// Shear modulus and bulk modulus of each element at small strain, Pa; empty for a pipeline that does not know them.
    fn moduli_of_elements(&self) -> Vec<[f64; 2]>;

    /// Plastic flow of the body; `None` for a body without plasticity.
    fn plastic_flow(&self) -> Option<PlasticFlow>;

    /// Reaction forces now, of `[fixed]` and of each `[[prescribed]]`; empty for a pipeline that does not compute them.
    fn reactions(&self) -> Vec<Reaction>;

    /// The forces of `[[planes]]` now; empty without obstacles.
    fn contacts(&self) -> Vec<PlaneContact>;

    /// Remarks on the scene as it was built, one line each, to be shown before the first step.
    fn notes(&self) -> Vec<String>;

    /// Reasons why the result of the run so far may mislead, one line each, with the remedy.
    fn warnings(&self) -> Vec<String>;

    /// The obstacles where they are now; empty without obstacles.
    fn planes(&self) -> Vec<Plane>;

    /// Weight of the body, N; `None` without gravity, and for a pipeline that does not compute it.
    fn weight(&self) -> Option<f64>;

    /// `(3n)` force of the obstacles on each node in the last step, N; `None` without obstacles.
    fn contact_forces(&self) -> Option<DVector<f64>>;

    /// The largest relative change that the normal forces of friction, which a step keeps fixed, were left with; `None` for a method
    /// without such forces.
    fn lag_residual(&self) -> Option<f64>;
}

/// A pipeline that computes the motion alone: every element has one stress and one material, and there are no obstacles.
pub trait Undiagnosed {}

impl<S: Undiagnosed + Simulation> Diagnostics for S {
    fn substeps(&self) -> usize {
        1
    }

    fn energy_ledger(&self) -> Option<EnergyLedger> {
        None
    }

    fn failure_at_end(&self) -> Option<Failure> {
        None
    }

    fn estimated_error(&self) -> Option<f64> {
        None
    }

    fn load_factor(&self) -> Option<f64> {
        None
    }

    fn inverted_elements(&self) -> usize {
        0
    }

    fn critical_time_step(&self) -> Option<f64> {
        None
    }

    fn has_stress(&self) -> bool {
        true
    }

    fn stresses_at_points(&self) -> Vec<Matrix3<f64>> {
        self.stresses()
    }

    fn material_of_elements(&self) -> Vec<usize> {
        Vec::new()
    }

    fn moduli_of_elements(&self) -> Vec<[f64; 2]> {
        Vec::new()
    }

    fn plastic_flow(&self) -> Option<PlasticFlow> {
        None
    }

    fn reactions(&self) -> Vec<Reaction> {
        Vec::new()
    }

    fn contacts(&self) -> Vec<PlaneContact> {
        Vec::new()
    }

    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    fn planes(&self) -> Vec<Plane> {
        Vec::new()
    }

    fn weight(&self) -> Option<f64> {
        None
    }

    fn contact_forces(&self) -> Option<DVector<f64>> {
        None
    }

    fn lag_residual(&self) -> Option<f64> {
        None
    }
}

/// The smallest number of substeps with which a step of `dt` is stable, given the critical time step, s; no number is enough if
/// that is zero.
pub fn least_stable_substeps(dt: f64, critical: f64) -> usize {
    // A substep as long as the critical time step is not stable.
    let least = (dt / critical).floor() + 1.0;
    if least.is_finite() { least as usize } else { usize::MAX }
}

/// The undeformed body.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Nodes and elements of the simulation.
    pub mesh: BodyMesh,
    /// Triangles of the surface, as indices of the nodes of `mesh`: the boundary of a solid body, counter-clockwise from outside, or all
    /// triangles of a flat one.
    pub boundary: Vec<[usize; 3]>,
    /// The display surface, if the scene has one.
    pub display: Option<SurfaceMesh>,
    /// The picture that a flat body was made from.
    pub picture: Option<PicturePlace>,
}

impl Shape {
    /// The faces of the boundary, as in [`BodyMesh::faces`].
    pub fn faces(&self) -> Vec<Vec<usize>> {
        match self.mesh.element() {
            // The boundary has been found before.
            Element { dimension: 3, triangles: [_], .. } => self.boundary.iter().map(|face| face.to_vec()).collect(),
            _ => self.mesh.faces(),
        }
    }

    /// Distance from a point of the boundary within which its nearest corner lies, m: the longest edge over √3.
    /// `x` are the positions of the nodes now, m.
    pub fn pick_radius(&self, x: &[Vector3<f64>]) -> f64 {
        let edges = self.boundary.iter().flat_map(|&[a, b, c]| [x[a] - x[b], x[b] - x[c], x[c] - x[a]]);
        edges.map(|edge| edge.norm()).fold(0.0, f64::max) / 3f64.sqrt()
    }
}

/// The reaction force of one Dirichlet condition.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// The scene's table: `fixed`, or such as `prescribed[0]`.
    pub name: String,
    /// Sum over the nodes of the force on the body, in the constrained directions, N.
    pub force: [f64; 3],
}

/// Numbers of operations so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs)] // the names are the documentation; they are the keys of the statistics file
pub struct Counters {
    pub steps: usize,
    pub newton_iterations: usize,
    pub unconverged_steps: usize,
    pub factorizations: usize,
    pub symbolic_factorizations: usize,
    pub solver_iterations: usize,
    /// Matrices that were factored because an iterative solver had broken down.
    pub solver_fallbacks: usize,
    pub force_assemblies: usize,
    pub stiffness_assemblies: usize,
    pub energy_evaluations: usize,
    pub line_search_backtracks: usize,
    pub projections: usize,
    pub accepted_steps: usize,
    pub rejected_steps: usize,
    pub skinning_rows: usize,
}
