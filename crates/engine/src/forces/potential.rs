//! The trait behind which every force stands, and the traits that it can opt into.

use fem_model::LoadCurve;
use fem_model::simulation::History;
use nalgebra::Matrix3;

use super::corner_pressures::CornerPressures;
use super::spring::Spring;
use super::{Energy, HessianKind};
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_solvers::Real;

/// Takes a block of a matrix of all nodes, given its row and its column. Blocks of the same place add up.
pub type AddBlock<'a, T> = dyn FnMut(usize, usize, Block<T, 3>) + 'a;

/// A force on the body: minus the gradient of an energy that depends on the displacements and the time.
///
/// A new one gives its value, gradient and Hessian. A method has a default only if that follows from these three, if it costs accuracy or
/// time at most, or if it says that the potential has no such facet: [`InElements`], [`Remembering`], [`Barrier`], [`Lagged`], [`Damped`],
/// [`Follower`].
///
/// Nodes have the engine's numbers ([`Numbering`](fem_solvers::numbering::Numbering)). `u` are the displacements of all nodes, m.
pub trait Potential<T: Real>: Send + Sync {
    /// Key in the statistics.
    fn name(&self) -> &'static str;

    /// One line for `--explain`: the table of the scene, and the resulting quantity.
    fn description(&self) -> String;

    /// Memory of its data, bytes.
    fn bytes(&self) -> usize;

    /// Energy, J: infinite where `u` is infeasible.
    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy;

    /// Adds the gradient of [`energy`](Self::energy), N: minus the force on each node.
    fn add_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]);

    /// Passes the blocks of the Hessian of [`energy`](Self::energy) to `add`, N/m, made positive semi-definite where `kind` asks for that; a
    /// pair of nodes in both orders. A pair that shares no element has a place in a matrix if its block is passed, be it zero, at u = 0.
    fn hessian(&self, u: &[[T; 3]], moment: Moment, kind: HessianKind, add: &mut AddBlock<T>);

    /// Adds `factor` times the Hessian to a matrix, N/m.
    fn add_hessian(
        &self,
        factor: T,
        u: &[[T; 3]],
        moment: Moment,
        kind: HessianKind,
        pattern: &Pattern,
        values: &mut [Block<T, 3>],
    ) {
        self.hessian(u, moment, kind, &mut |row, column, block| match pattern.find(row, column) {
            Some(place) => add_block(factor, &block, &mut values[place]),
            None => assert!(
                is_left_out(pattern, row, column),
                "the force `{}` couples nodes {row} and {column} without a place in the matrix: it must pass their block at u = 0 as well",
                self.name()
            ),
        });
    }

    /// Adds `factor` times the exact Hessian times `d`, N.
    fn add_hessian_times(&self, factor: T, u: &[[T; 3]], moment: Moment, d: &[[T; 3]], product: &mut [[T; 3]]) {
        self.hessian(u, moment, HessianKind::Exact, &mut |row, column, block| {
            let d = d[column];
            for (sum, of) in product[row].iter_mut().zip(&block) {
                *sum += factor * (of[0] * d[0] + of[1] * d[1] + of[2] * d[2]);
            }
        });
    }

    /// Finds where its Hessian and its damping matrix add to matrices with a pattern, before any of them is assembled, to save time later.
    fn set_pattern(&mut self, _pattern: &Pattern) {}

    /// The nodes whose blocks its Hessian and its damping matrix may add to; `None` if these may be any.
    fn nodes_of_hessian(&self) -> Option<Vec<u32>> {
        None
    }

    /// Called once before each step of `dt` seconds, with the displacements at its start, for a potential that keeps quantities fixed
    /// within a step.
    fn begin_step(&mut self, _u: &[[T; 3]], _start: Moment, _dt: f64) {}

    /// Returns true if the energy depends on the displacements alone: its work is then their difference. Otherwise the energy ledger sums
    /// the work over the steps, with the error of the time integration.
    fn is_steady(&self) -> bool {
        false
    }

    /// The forces on all nodes in dynamics, N, if they are constant.
    fn constant(&self) -> Option<&[[T; 3]]> {
        None
    }

    /// Sum of the forces on all nodes where that does not depend on `u`, N; `None` where it does, or where it is not known.
    fn resultant(&self, _moment: Moment) -> Option<[f64; 3]> {
        None
    }

    /// The scene's field and the quantity that are out of range of the number type; `None` if all are in range.
    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        None
    }

    /// The springs of which it consists, for methods that treat them one by one. A force of springs is an internal one of the body: its
    /// Hessian is part of the stiffness K in Rayleigh's damping.
    fn springs(&self) -> &[Spring<T>] {
        &[]
    }

    /// Itself, if it is a stress within the elements.
    fn in_elements(&self) -> Option<&dyn InElements<T>> {
        None
    }

    /// Itself, if pressures are unknowns beside the displacements.
    fn mixed(&self) -> Option<&CornerPressures> {
        None
    }

    /// Itself, if it keeps quantities from step to step.
    fn remembering(&self) -> Option<&dyn Remembering> {
        None
    }

    /// The same as [`remembering`](Self::remembering), to be changed.
    fn remembering_mut(&mut self) -> Option<&mut dyn Remembering> {
        None
    }

    /// Itself, if it is infinite beyond a limit.
    fn barrier(&self) -> Option<&dyn Barrier<T>> {
        None
    }

    /// Itself, if it keeps a quantity fixed within a step that depends on the displacements at its end.
    fn lagged(&self) -> Option<&dyn Lagged<T>> {
        None
    }

    /// The same as [`lagged`](Self::lagged), to be changed.
    fn lagged_mut(&mut self) -> Option<&mut dyn Lagged<T>> {
        None
    }

    /// Itself, if it also damps motions.
    fn damped(&self) -> Option<&dyn Damped<T>> {
        None
    }

    /// Itself, if it also has a force that is the gradient of no energy.
    fn follower(&self) -> Option<&dyn Follower<T>> {
        None
    }
}

/// A potential that repels the body from infeasible displacements, where its energy is infinite. It is evaluated at the end of a step,
/// whatever the stage of the other forces, so that the body ends outside. Li et al., Incremental Potential Contact (2020), section 4.
pub trait Barrier<T: Real> {
    /// The distance over which the force changes, where it is much shorter than the body, m.
    fn scale(&self) -> f64;

    /// The largest multiple of `direction` up to which `u` plus it is certain to stay feasible.
    fn largest_step(&self, u: &[[T; 3]], moment: Moment, direction: &[[T; 3]]) -> f64;

    /// Changes the increment of a step from `start`, an initial guess, where it would be infeasible, m. Returns whether it has.
    fn make_feasible(&self, start: &[[T; 3]], end: Moment, increment: &mut [[T; 3]]) -> bool;
}

/// A potential of a single step, such as friction, whose lagged quantity stays fixed while Newton's method runs. The step is repeated
/// until that no longer changes. The energy of the body does not contain it. Li et al., Incremental Potential Contact (2020), section 5.
pub trait Lagged<T: Real> {
    /// Evaluates the lagged quantity again, at the displacements of the end of the step, and applies this part of its change (1 for all of
    /// it). Returns the whole relative change.
    fn update(&mut self, u: &[[T; 3]], relaxation: f64) -> f64;
}

/// A force −D(u) v that damps motions, with a damping matrix D that is positive semi-definite. Implicit methods take D at the displacements
/// at which damping takes the stiffness, fixed within a step, so that ½ ẋᵀ D ẋ is a dissipation potential.
pub trait Damped<T: Real> {
    /// Adds `factor` D(u) v, N.
    fn add_damping_times(&self, factor: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]);

    /// Adds `factor` D(u) to a matrix with the pattern that was [set](Potential::set_pattern), N s/m.
    fn add_damping_matrix(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]);
}

/// A stress within the elements beside that of their laws.
pub trait InElements<T: Real> {
    /// Returns true if its energy is part of the body's own, whose Hessian is part of the stiffness K in Rayleigh's damping. Otherwise its energy
    /// belongs to a single step, and dissipates some.
    fn is_elastic(&self) -> bool;

    /// Adds its Cauchy stresses at the quadrature points, Pa: those of the mesh's first element, then those of the next.
    fn add_stresses(&self, u: &[[T; 3]], moment: Moment, stresses: &mut [Matrix3<f64>]);
}

/// A force that keeps quantities from step to step: checkpoints hold them.
pub trait Remembering {
    /// Adds them to a history.
    fn save(&self, history: &mut History);

    /// Restores the quantities that [`save`](Self::save) has added.
    fn restore(&mut self, history: &History) -> Result<(), String>;
}

/// A follower load: a force that turns with the body and need not have an energy. Implicit methods keep it fixed while Newton's method
/// runs, and evaluate it again until it no longer changes.
pub trait Follower<T: Real> {
    /// Adds minus the force on each node, N.
    fn add_follower_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]);

    /// Energy for reports, J: zero for a load without a potential.
    fn reported_energy(&self, u: &[[T; 3]], moment: Moment) -> f64;
}

/// Properties of a force that follow from its facets.
impl<T: Real> dyn Potential<T> + '_ {
    /// Returns true for a force that is part of the body's own elasticity: of springs between its nodes, or of the volume of its elements.
    pub fn is_internal(&self) -> bool {
        !self.springs().is_empty() || self.in_elements().is_some_and(|stress| stress.is_elastic())
    }

    /// Returns true for the forces of obstacles, which are evaluated at the end of a step: barriers, and friction on them.
    pub fn is_obstacle(&self) -> bool {
        self.barrier().is_some() || self.lagged().is_some()
    }

    /// Returns true if the energy of the body does not contain that of the force, which belongs to a single step.
    pub fn is_dissipative(&self) -> bool {
        self.lagged().is_some() || self.is_relaxing()
    }

    /// Returns true for a stress within the elements that relaxes.
    pub fn is_relaxing(&self) -> bool {
        self.in_elements().is_some_and(|stress| !stress.is_elastic())
    }

    /// Returns true if the whole force is minus the gradient of its energy.
    pub fn is_conservative(&self) -> bool {
        self.follower().is_none()
    }

    /// Returns true if the energy may be quadratic. Whether it is shows where forces are evaluated.
    pub fn may_be_quadratic(&self) -> bool {
        !self.is_internal() && !self.is_obstacle() && self.is_conservative()
    }

    /// Adds minus the whole force on each node, N.
    pub fn subtract_force(&self, u: &[[T; 3]], moment: Moment, sum: &mut [[T; 3]]) {
        self.add_gradient(u, moment, sum);
        if let Some(follower) = self.follower() {
            follower.add_follower_gradient(u, moment, sum);
        }
    }
}

/// Adds `factor` times a block.
pub(super) fn add_block<T: Real>(factor: T, block: &Block<T, 3>, sum: &mut Block<T, 3>) {
    for (sum, entry) in sum.as_flattened_mut().iter_mut().zip(block.as_flattened()) {
        *sum += factor * *entry;
    }
}

/// Returns true for a block that no matrix with the pattern stores: one of a fully constrained node, or of an upper half.
fn is_left_out(pattern: &Pattern, row: usize, column: usize) -> bool {
    row.max(column) >= pattern.rows() || pattern.stored == Stored::Lower && column > row
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
