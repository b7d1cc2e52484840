//! Forces on the body beside its own elasticity: the trait [`Potential`], and one file for each force.

mod averaged_volume;
mod central_gravity;
pub mod contact;
mod corner_pressures;
pub mod dead_load;
pub mod drag;
mod energy;
mod fibres;
mod hessian_kind;
pub mod mass_spring;
mod mixed_volume;
mod points;
mod potential;
pub mod pressure;
mod spring;
pub mod springs;
mod viscoelasticity;
mod volume_change;

use fem_model::simulation::History;
use fem_model::{Body, Timer};

pub(crate) use corner_pressures::CornerPressures;
use drag::DragSprings;
pub use energy::Energy;
use fem_elements::sparse::Pattern;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;
pub use hessian_kind::HessianKind;
pub use potential::{AddBlock, Barrier, Damped, Follower, InElements, Lagged, Moment, Potential, Remembering};

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

/// Every force that a scene can ask for; `[drag]` and the user's interaction are [`DragSprings`].
pub fn kinds<T: Real>() -> [Kind<T>; 11] {
    [
        Kind { name: mass_spring::NAME, tables: "[material] with model \"mass_spring\"", build: mass_spring::build },
        Kind {
            name: averaged_volume::NAME,
            tables: "[material] with volumetric = \"averaged\"",
            build: averaged_volume::build,
        },
        Kind { name: mixed_volume::NAME, tables: "[material] with volumetric = \"mixed\"", build: mixed_volume::build },
        Kind { name: fibres::NAME, tables: "[[fibres]]", build: fibres::build },
        Kind { name: springs::NAME, tables: "[[springs]]", build: springs::build },
        Kind { name: dead_load::NAME, tables: "dead load", build: dead_load::build },
        Kind { name: pressure::NAME, tables: "[[traction]] with pressure", build: pressure::build },
        Kind { name: central_gravity::NAME, tables: "[central_gravity]", build: central_gravity::build },
        Kind { name: viscoelasticity::NAME, tables: "[viscosity]", build: viscoelasticity::build },
        Kind { name: contact::NAME, tables: "[[planes]]", build: contact::build },
        Kind { name: contact::friction::NAME, tables: "[[planes]] with friction", build: contact::friction::build },
    ]
}

/// All forces of a body, each with its timer.
pub struct Forces<T: Real> {
    potentials: Vec<(Box<dyn Potential<T>>, Timer)>,
    /// Springs from nodes to points in space: `[drag]`, or the user's interaction.
    pub drag: DragSprings,
    /// Uses and time of these.
    pub drag_timer: Timer,
}

impl<T: Real> Forces<T> {
    /// The forces that the scene asks for, the drag springs, and `own` ones.
    pub fn new(body: &Body, drag: DragSprings, numbering: &Numbering, own: Vec<Box<dyn Potential<T>>>) -> Self {
        let named = kinds().into_iter().filter_map(|kind| (kind.build)(body, numbering));
        let with_timer = |mut potential: Box<dyn Potential<T>>| {
            let (name, is_lagged) = (potential.name(), potential.lagged().is_some());
            assert_eq!(is_lagged, potential.lagged_mut().is_some(), "`{name}`: lagged and lagged_mut belong together");
            (potential, Timer::default())
        };
        let potentials = named.chain(own).map(with_timer).collect();
        Self { potentials, drag, drag_timer: Timer::default() }
    }

    /// All forces that the scene asks for, active or not, and their timers.
    pub fn all(&self) -> impl Iterator<Item = (&dyn Potential<T>, &Timer)> {
        self.first(self.potentials.len() + 1)
    }

    /// The same without the drag springs while there are none.
    pub fn active(&self) -> impl Iterator<Item = (&dyn Potential<T>, &Timer)> {
        self.first(self.potentials.len() + usize::from(self.drag.is_active()))
    }

    fn first(&self, count: usize) -> impl Iterator<Item = (&dyn Potential<T>, &Timer)> {
        (0..count).map(|number| match self.potentials.get(number) {
            Some((potential, timer)) => (&**potential, timer),
            None => (&self.drag as &dyn Potential<T>, &self.drag_timer),
        })
    }

    /// Pairs of the nodes of a body that Hessians couple, in both orders.
    pub fn couplings(&self, nodes: usize) -> Vec<[u32; 2]> {
        let (undeformed, mut pairs) = (vec![[T::default(); 3]; nodes], Vec::new());
        for (potential, _) in self.all() {
            potential.hessian(&undeformed, Moment::at(0.0), HessianKind::Exact, &mut |row, column, _| {
                if row != column {
                    pairs.push([row as u32, column as u32]);
                }
            });
        }
        pairs
    }

    /// The nodes, in ascending order, whose blocks the Hessians and damping matrices of active forces may add to; `None` if these may be any.
    pub fn nodes_of_hessians(&self) -> Option<Vec<u32>> {
        let of_forces: Option<Vec<_>> = self.active().map(|(force, _)| force.nodes_of_hessian()).collect();
        let mut nodes = of_forces?.concat();
        nodes.sort_unstable();
        nodes.dedup();
        Some(nodes)
    }

    /// The energy of the volume whose pressures are unknowns beside the displacements.
    pub fn mixed(&self) -> Option<&CornerPressures> {
        self.potentials.iter().find_map(|(potential, _)| potential.mixed())
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
        self.active().filter_map(|(force, _)| force.barrier()).map(|of| of.scale()).fold(f64::INFINITY, f64::min)
    }

    /// Returns true if the body has a follower load.
    pub fn has_followers(&self) -> bool {
        self.active().any(|(potential, _)| !potential.is_conservative())
    }

    /// Adds the quantities that forces keep from step to step to a history.
    pub fn save(&self, history: &mut History) {
        self.all().filter_map(|(force, _)| force.remembering()).for_each(|force| force.save(history));
    }

    /// Restores the quantities that [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        let mut forces = self.potentials.iter_mut().filter_map(|(force, _)| force.remembering_mut());
        forces.try_for_each(|force| force.restore(history))
    }

    /// Prepares every force for a step of `dt` seconds from the displacements `u`.
    pub fn begin_step(&mut self, u: &[[T; 3]], start: Moment, dt: f64) {
        self.potentials.iter_mut().for_each(|(potential, _)| potential.begin_step(u, start, dt));
    }

    /// Returns true if a force keeps a quantity fixed within a step that depends on the displacements at its end.
    pub fn has_lag(&self) -> bool {
        self.active().any(|(potential, _)| potential.lagged().is_some())
    }

    /// Evaluates the lagged quantities of forces again, and applies this part of their change. Returns the largest relative change.
    pub fn update_lag(&mut self, u: &[[T; 3]], relaxation: f64) -> f64 {
        let lagged = self.potentials.iter_mut().filter_map(|(potential, _)| potential.lagged_mut());
        lagged.map(|lagged| lagged.update(u, relaxation)).fold(0.0, f64::max)
    }
}
