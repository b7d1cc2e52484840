//! Forces on the body beside its own elasticity: the trait [`Potential`], and one file for each force.

pub mod anchors;
pub mod contact;
pub mod dead_load;
mod energy;
pub mod mass_spring;
pub mod pressure;
pub mod springs;

use fem_model::{Body, LoadCurve, Timer};

use crate::model::numbering::Numbering;
use anchors::Anchors;
pub use energy::Energy;
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};

/// A force on the body. External forces are functions of time; a conservative one is minus the gradient of its energy.
///
/// Nodes have the engine's numbers ([`Numbering`]). `u` are the displacements of all nodes, m.
pub trait Potential<T: Real>: Send + Sync {
    /// Key in the statistics.
    fn name(&self) -> &'static str;

    /// One line for `--explain`: the table of the scene, and the resulting quantity.
    fn description(&self) -> String;

    /// Memory of its data, bytes.
    fn bytes(&self) -> usize;

    /// Returns true if the force has an effect now. An inactive force is skipped.
    fn is_active(&self) -> bool {
        true
    }

    /// Returns true for an internal force of the body: its Hessian is part of the stiffness K in Rayleigh's damping.
    fn is_internal(&self) -> bool {
        false
    }

    /// Returns true if the force is minus the gradient of [`energy`](Self::energy). A follower load is not conservative: implicit methods
    /// keep its force fixed while Newton's method runs, and evaluate it again until it no longer changes.
    fn is_conservative(&self) -> bool {
        true
    }

    /// Returns true if the energy depends on the displacements alone, and not on the time.
    fn is_steady(&self) -> bool {
        true
    }

    /// Pairs of nodes, beyond those that share an element, which its Hessian couples.
    fn couplings(&self) -> Vec<[u32; 2]> {
        Vec::new()
    }

    /// Finds where its Hessian adds to matrices with a pattern, before any of them is assembled.
    fn set_pattern(&mut self, _pattern: &Pattern) {}

    /// Returns true if the energy is at most quadratic in the displacements: one linear solve then finds equilibrium.
    fn is_quadratic(&self) -> bool {
        self.is_conservative() && !self.is_internal()
    }

    /// Returns true for a friction potential: it belongs to a single step, and the energy of the body does not contain it.
    fn is_dissipative(&self) -> bool {
        false
    }

    /// Returns true for the contact force of an obstacle. It is evaluated at the end of a step, whatever the stage of the other
    /// forces, so that the body ends outside of it.
    fn is_obstacle(&self) -> bool {
        false
    }

    /// Called once before each step of `dt` seconds, with the displacements at its start.
    fn begin_step(&mut self, _u: &[[T; 3]], _start: Moment, _dt: f64) {}

    /// Returns true if the force keeps a quantity fixed within a step that depends on the displacements at its end. The step is
    /// repeated until [`update_lag`](Self::update_lag) no longer changes it.
    fn has_lag(&self) -> bool {
        false
    }

    /// Evaluates the lagged quantity again, at the displacements of the end of the step, and applies this part of its change (1 for all of
    /// it). Returns the whole relative change.
    fn update_lag(&mut self, _u: &[[T; 3]], _relaxation: f64) -> f64 {
        0.0
    }

    /// Changes the increment of a step from `start`, an initial guess, where it would be infeasible, m. Returns whether it has.
    fn make_feasible(&self, _start: &[[T; 3]], _end: Moment, _increment: &mut [[T; 3]]) -> bool {
        false
    }

    /// The springs of which it consists, for methods that treat them one by one.
    fn springs(&self) -> &[springs::Spring<T>] {
        &[]
    }

    /// Energy, J: infinite where `u` is infeasible. A follower load without a potential returns zero.
    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy;

    /// Adds minus the force on each node, N: the gradient of [`energy`](Self::energy) where it is conservative.
    fn add_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]);

    /// The nodes whose blocks its Hessian and its damping matrix may add to; `None` if these may be any.
    fn nodes_of_hessian(&self) -> Option<Vec<u32>> {
        None
    }

    /// Adds `factor` times the Hessian of the energy, N/m; made positive semi-definite where `kind` asks for that.
    fn add_hessian(
        &self,
        _factor: T,
        _u: &[[T; 3]],
        _moment: Moment,
        _kind: HessianKind,
        _pattern: &Pattern,
        _values: &mut [Block<T, 3>],
    ) {
    }

    /// Adds `factor` times the exact Hessian times `d`, N.
    fn add_hessian_times(&self, _factor: T, _u: &[[T; 3]], _moment: Moment, _d: &[[T; 3]], _product: &mut [[T; 3]]) {}

    /// Returns true if the force damps motions by −D(u) v, with a positive semi-definite damping matrix D. Implicit methods take D at the
    /// displacements at which damping takes the stiffness, fixed within a step, so that ½ ẋᵀ D ẋ is a dissipation potential.
    fn has_damping(&self) -> bool {
        false
    }

    /// Adds `factor` D(u) v, N.
    fn add_damping_times(&self, _factor: T, _u: &[[T; 3]], _v: &[[T; 3]], _product: &mut [[T; 3]]) {}

    /// Adds `factor` D(u) to a matrix, N s/m.
    fn add_damping_matrix(&self, _factor: T, _u: &[[T; 3]], _values: &mut [Block<T, 3>]) {}

    /// The largest multiple of `direction` up to which `u` plus it is certain to stay feasible.
    fn largest_step(&self, _u: &[[T; 3]], _moment: Moment, _direction: &[[T; 3]]) -> f64 {
        f64::INFINITY
    }

    /// The forces on all nodes in dynamics, N, if they are constant.
    fn constant(&self) -> Option<&[[T; 3]]> {
        None
    }

    /// The distance over which the force changes where it is much shorter than the body, m.
    fn scale(&self) -> f64 {
        f64::INFINITY
    }

    /// Sum of the forces on all nodes where that does not depend on `u`, N; `None` where it does.
    fn resultant(&self, _moment: Moment) -> Option<[f64; 3]> {
        None
    }

    /// The scene's field and the quantity that are out of range of the number type; `None` if all are in range.
    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        None
    }
}

/// The moment at which external forces and prescribed motions are evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// s
    pub time: f64,
    /// Load factor of a load step, 0 to 1: it scales loads and prescribed motions without a curve. `None` in dynamics, where these have
    /// their full size.
    pub load_factor: Option<f64>,
}

impl Moment {
    /// A moment of a motion, s.
    pub fn at(time: f64) -> Self {
        Self { time, load_factor: None }
    }

    /// Factor of an external load or of a prescribed motion: that of its curve at the time, and without a curve the load factor.
    pub fn factor(self, curve: Option<&LoadCurve>) -> f64 {
        curve.map_or(self.load_factor.unwrap_or(1.0), |curve| curve.factor(self.time))
    }

    /// The moment after this part of the way to another one.
    pub fn towards(self, end: Self, part: f64) -> Self {
        let between = |from: f64, to: f64| if part == 1.0 { to } else { from + part * (to - from) };
        let factors = self.load_factor.zip(end.load_factor);
        Self { time: between(self.time, end.time), load_factor: factors.map(|(from, to)| between(from, to)) }
    }
}

/// Kind of a Hessian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HessianKind {
    /// The second derivative as it is.
    Exact,
    /// The part of each element and of each force is projected to a positive semi-definite matrix.
    Projected,
}

/// A kind of force, which is built if the scene asks for it.
pub struct Kind<T: Real> {
    /// Key in the statistics.
    pub name: &'static str,
    /// The scene's tables that ask for it.
    pub tables: &'static str,
    /// Builds it; `None` where the scene does not ask for it.
    pub build: Builder<T>,
}

/// Builds a force of a body.
pub type Builder<T> = fn(&Body, &Numbering) -> Option<Box<dyn Potential<T>>>;

/// Every force that a scene can ask for; `[drag]` and the user's interaction are [`Anchors`].
pub fn kinds<T: Real>() -> [Kind<T>; 6] {
    [
        Kind { name: mass_spring::NAME, tables: "[material] with model \"mass_spring\"", build: mass_spring::build },
        Kind { name: springs::NAME, tables: "[[springs]]", build: springs::build },
        Kind { name: dead_load::NAME, tables: "dead load", build: dead_load::build },
        Kind { name: pressure::NAME, tables: "[[traction]] with pressure", build: pressure::build },
        Kind { name: contact::NAME, tables: "[[planes]]", build: contact::build },
        Kind { name: contact::friction::NAME, tables: "[[planes]] with friction", build: contact::friction::build },
    ]
}

/// All forces of a body, each with its timer.
pub struct Forces<T: Real> {
    potentials: Vec<(Box<dyn Potential<T>>, Timer)>,
    /// Anchor springs from nodes to points in space: `[drag]`, or the user's interaction.
    pub anchors: Anchors,
    /// Uses and time of these.
    pub anchors_timer: Timer,
}

impl<T: Real> Forces<T> {
    /// The forces that the scene asks for, the anchor springs, and `own` ones.
    pub fn new(body: &Body, anchors: Anchors, numbering: &Numbering, own: Vec<Box<dyn Potential<T>>>) -> Self {
        let named = kinds().into_iter().filter_map(|kind| (kind.build)(body, numbering));
        let potentials = named.chain(own).map(|potential| (potential, Timer::default())).collect();
        Self { potentials, anchors, anchors_timer: Timer::default() }
    }

    /// All forces that the scene asks for, active or not, and their timers.
    pub fn all(&self) -> impl Iterator<Item = (&dyn Potential<T>, &Timer)> {
        let own = self.potentials.iter().map(|(potential, timer)| (&**potential, timer));
        own.chain(std::iter::once((&self.anchors as &dyn Potential<T>, &self.anchors_timer)))
    }

    /// The active ones.
    pub fn active(&self) -> impl Iterator<Item = (&dyn Potential<T>, &Timer)> {
        self.all().filter(|(potential, _)| potential.is_active())
    }

    /// The nodes, in ascending order, whose blocks the Hessians and damping matrices of active forces may add to; `None` if these may be any.
    pub fn nodes_of_hessians(&self) -> Option<Vec<u32>> {
        let of_forces: Option<Vec<_>> = self.active().map(|(force, _)| force.nodes_of_hessian()).collect();
        let mut nodes = of_forces?.concat();
        nodes.sort_unstable();
        nodes.dedup();
        Some(nodes)
    }

    /// Prepares the assembly of matrices with a pattern.
    pub fn set_pattern(&mut self, pattern: &Pattern) {
        self.potentials.iter_mut().for_each(|(potential, _)| potential.set_pattern(pattern));
    }

    /// Returns true if the body has obstacles.
    pub fn has_obstacles(&self) -> bool {
        self.active().any(|(potential, _)| potential.is_obstacle())
    }

    /// The shortest distance over which a force changes, m.
    pub fn smallest_scale(&self) -> f64 {
        self.active().map(|(potential, _)| potential.scale()).fold(f64::INFINITY, f64::min)
    }

    /// Returns true if the body has a follower load.
    pub fn has_followers(&self) -> bool {
        self.active().any(|(potential, _)| !potential.is_conservative())
    }

    /// Prepares every force for a step of `dt` seconds from the displacements `u`.
    pub fn begin_step(&mut self, u: &[[T; 3]], start: Moment, dt: f64) {
        self.potentials.iter_mut().for_each(|(potential, _)| potential.begin_step(u, start, dt));
    }

    /// Returns true if a force keeps a quantity fixed within a step that depends on the displacements at its end.
    pub fn has_lag(&self) -> bool {
        self.active().any(|(potential, _)| potential.has_lag())
    }

    /// Evaluates the lagged quantities of forces again, and applies this part of their change. Returns the largest relative change.
    pub fn update_lag(&mut self, u: &[[T; 3]], relaxation: f64) -> f64 {
        self.potentials.iter_mut().map(|(potential, _)| potential.update_lag(u, relaxation)).fold(0.0, f64::max)
    }
}
