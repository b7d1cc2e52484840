//! The step of methods that relax a body in sweeps: PBD, XPBD and vertex block descent. Nodes move to the positions of inertia and dead
//! loads alone, sweeps correct these positions, and velocities follow from them: Müller, Heidelberger, Hennix and Ratcliff,
//! Position based dynamics (2007), algorithm 1. A method implements its sweep in [`Relaxation`].

mod coloring;
mod contact;
mod particles;
mod shape;

pub(crate) use coloring::color_nodes;
pub use coloring::{cliques_of_nodes, color_constraints};
pub use contact::{ContactStep, PlaneContacts};
pub use particles::{Particles, largest_difference};
pub use shape::{Shape, inner, shape};

use fem_model::IterationSettings;
use fem_model::simulation::{Cause, Counters, History};

use super::{Convergence, Integrator, Memory};
use crate::forces::contact::planes::Planes;
use crate::model::state::State;
use crate::model::system::System;
use fem_solvers::Real;

/// Batches of one colour that a thread takes at a time.
pub const CHUNK: usize = 16;

/// From this many batches of a colour on several threads share them.
pub const BATCHES_FOR_THREADS: usize = 4 * CHUNK;

/// A relaxation method: each sweep moves every node of a body once.
pub trait Relaxation<T: Real>: Send {
    /// Returns true if the motion is that of the material, so that the energy of the elements measures the convergence of the sweeps.
    fn has_material(&self) -> bool;

    /// Takes the inverse masses of the nodes, 1/kg, zero in directions that are constrained now.
    fn set_masses(&mut self, inverse_masses: &[[T; 3]]);

    /// Starts a step from the displacements that inertia and dead loads alone would give.
    fn begin_step(&mut self, step: StepOf<T>, u: &[[T; 3]]);

    /// Moves every node once.
    fn sweep(&mut self, step: StepOf<T>, contacts: Option<&mut PlaneContacts>, u: &mut [[T; 3]]);
}

/// A step for its sweeps.
pub struct StepOf<'a, T: Real> {
    /// The body.
    pub system: &'a System<T>,
    /// Its nodes.
    pub particles: &'a Particles<T>,
    /// Square of the time that forces have to move nodes, s².
    pub dt2: f64,
    /// Start and end, s.
    pub times: [f64; 2],
}

impl<T: Real> Clone for StepOf<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Real> Copy for StepOf<'_, T> {}

impl<'a, T: Real> StepOf<'a, T> {
    /// The step for contacts.
    pub fn of_contacts(&self) -> ContactStep<'a, T> {
        let Particles { start, inverse_masses, .. } = self.particles;
        ContactStep { start, inverse_masses, times: self.times }
    }
}

/// A method of sweeps as an integrator. A step takes `count` sweeps, or fewer where the relative change of the velocity falls below the
/// tolerance.
pub struct Relaxed<T: Real, R> {
    relaxation: R,
    count: usize,
    tolerance: Option<f64>,
    particles: Particles<T>,
    contacts: Option<PlaneContacts>,
    /// Displacements before a sweep, m; empty where no tolerance is asked for.
    before: Vec<[T; 3]>,
    /// True if the masses are those of the Dirichlet conditions that apply now.
    has_masses: bool,
}

impl<T: Real, R: Relaxation<T>> Relaxed<T, R> {
    /// The nodes of a body, and the planes that they must not pass.
    pub fn new(relaxation: R, settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Self {
        let before = if settings.tolerance.is_some() { vec![[T::default(); 3]; system.nodes()] } else { Vec::new() };
        Self {
            relaxation,
            count: settings.count,
            tolerance: settings.tolerance,
            particles: Particles::new(system),
            contacts: planes.map(|planes| PlaneContacts::new(planes.clone(), system.length)),
            before,
            has_masses: false,
        }
    }

    /// The sweeps of a step. Returns whether the tolerance was reached, if there is one.
    fn sweeps(
        &mut self,
        system: &System<T>,
        dt2: f64,
        times: [f64; 2],
        u: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> bool {
        let Self { relaxation, particles, contacts, before, .. } = self;
        let step = StepOf { system, particles, dt2, times };
        relaxation.begin_step(step, u);
        for _ in 0..self.count {
            counters.solver_iterations += 1;
            let Some(tolerance) = self.tolerance else {
                relaxation.sweep(step, contacts.as_mut(), u);
                continue;
            };
            before.copy_from_slice(u);
            relaxation.sweep(step, contacts.as_mut(), u);
            if largest_difference(u, before) <= tolerance * particles.largest_increment(u) {
                return true;
            }
        }
        self.tolerance.is_none()
    }
}

impl<T: Real, R: Relaxation<T>> Memory for Relaxed<T, R> {
    fn accept(&mut self) {}

    fn forget(&mut self) {
        self.has_masses = false;
        if let Some(contacts) = &mut self.contacts {
            contacts.begin_step(1.0);
        }
    }

    fn forget_forces(&mut self) {}

    fn save(&self, history: &mut History) {
        if let Some(contacts) = &self.contacts {
            contacts.save(history);
        }
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        self.contacts.as_mut().map_or(Ok(()), |contacts| contacts.restore(history))
    }
}

impl<T: Real, R: Relaxation<T>> Integrator<T> for Relaxed<T, R> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        if !self.has_masses {
            self.particles.set_masses(system);
            self.relaxation.set_masses(&self.particles.inverse_masses);
            self.has_masses = true;
        }
        let dt2 = self.particles.predict(system, state, dt);
        let times = [state.time, state.time + dt];
        if let Some(contacts) = &mut self.contacts {
            contacts.begin_step(dt2);
        }
        let has_settled = self.sweeps(system, dt2, times, &mut state.u, counters);
        let Self { particles, contacts, .. } = self;
        if let Some(contacts) = contacts {
            contacts.end_step(StepOf { system, particles, dt2, times }.of_contacts(), &mut state.u);
        }
        particles.finish(state, dt);
        Ok(if has_settled { Convergence::Converged } else { Convergence::NotConverged })
    }

    fn may_stop_early(&self) -> bool {
        self.relaxation.has_material() && self.tolerance.is_none()
    }

    fn plane_contacts(&self) -> Option<&PlaneContacts> {
        self.contacts.as_ref()
    }
}
