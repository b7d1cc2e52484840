//! Works in one step that depend on the path: of loads that change or follow the body, of prescribed motions and of moving obstacles, and
//! the energy that damping, stresses that relax, and friction dissipate; those of a stress that relaxes contain what its springs store.
//!
//! Methods of first order take all forces at the end of a step, so their works are F₁ · Δu: then implicit Euler only loses energy. The
//! others take the mean of the forces at start and end, or those at their stage, which is exact for the trapezoidal and the midpoint
//! rule. Explicit methods sum the powers of damping and reactions at their stages. Obstacles act at the end of a step in all methods.

use std::ops::AddAssign;

use super::Simulator;
use super::energies::{Bounds, is_changing_load};
use crate::forces::contact::friction::tangential;
use crate::forces::{Moment, Potential};
use crate::integrators::LastEvaluation;
use crate::model::reactions::{End, Unbalanced, write_between};
use crate::model::system::System;
use fem_elements::history::put;
use fem_elements::vector::{dot, scale, set_zero, triple};
use fem_model::Integrator as IntegratorKind;
use fem_model::simulation::History;
use fem_solvers::Real;
use nalgebra::Vector3;

/// Energies supplied and dissipated, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct StepWork {
    pub loads: f64,
    pub motions: f64,
    pub obstacles: f64,
    pub rayleigh: f64,
    pub dampers: f64,
    pub friction: f64,
}

impl StepWork {
    /// By loads, prescribed motions and moving obstacles, J.
    pub(super) fn supplied(&self) -> f64 {
        self.loads + self.motions + self.obstacles
    }

    /// By damping and friction, J.
    pub(super) fn dissipated(&self) -> f64 {
        self.rayleigh + self.dampers + self.friction
    }

    pub(super) fn to_array(self) -> [f64; 6] {
        [self.loads, self.motions, self.obstacles, self.rayleigh, self.dampers, self.friction]
    }

    pub(super) fn from_array([loads, motions, obstacles, rayleigh, dampers, friction]: [f64; 6]) -> Self {
        Self { loads, motions, obstacles, rayleigh, dampers, friction }
    }
}

impl AddAssign<&Self> for StepWork {
    fn add_assign(&mut self, other: &Self) {
        let (a, b) = (self.to_array(), other.to_array());
        *self = Self::from_array(std::array::from_fn(|i| a[i] + b[i]));
    }
}

/// Forces and bounds of the motion at the end of the last step, which the ledger of the next one needs; empty where they are not known.
#[derive(Clone, Debug, Default)]
pub(super) struct LastForces<T> {
    /// Of changing loads, N.
    pub(super) loads: Vec<[T; 3]>,
    /// Of the prescribed motions on the body, N.
    pub(super) reactions: Vec<[T; 3]>,
    /// Of damping against the motion, N.
    damping: Vec<[T; 3]>,
    /// Of the velocities.
    pub(super) bounds: Option<Bounds>,
}

impl<T: Real> LastForces<T> {
    /// Forgets them: the state or the forces are new.
    pub(super) fn forget(&mut self) {
        self.loads.clear();
        self.reactions.clear();
        self.damping.clear();
        self.bounds = None;
    }

    /// Adds them to a history.
    pub(super) fn save(&self, history: &mut History) {
        put(history, "ledger.load_forces", self.loads.as_flattened());
        put(history, "ledger.reactions", self.reactions.as_flattened());
        put(history, "ledger.damping", self.damping.as_flattened());
    }

    /// Restores the forces that [`save`](Self::save) has added.
    pub(super) fn restore(&mut self, history: &History, nodes: usize) -> Result<(), String> {
        self.bounds = None;
        let Self { loads, reactions, damping, .. } = self;
        let vectors = [("ledger.load_forces", loads), ("ledger.reactions", reactions), ("ledger.damping", damping)];
        for (name, vector) in vectors {
            let (found, _) = history.get(name)?.as_chunks::<3>();
            if !found.is_empty() && found.len() != nodes {
                return Err(format!("its history has {} nodes of `{name}` and not {nodes}", found.len()));
            }
            *vector = found.iter().map(|force| force.map(T::of)).collect();
        }
        Ok(())
    }
}

/// Vectors that works overwrite.
#[derive(Clone, Debug, Default)]
pub(super) struct Room<T> {
    /// Change of the displacements in the step, m; that of constrained ones alone once the work of reactions is known.
    change: Vec<[T; 3]>,
    /// Any.
    pub(super) other: Vec<[T; 3]>,
    unbalanced: Unbalanced<T>,
}

impl<T: Real> Simulator<T> {
    /// Writes the works of the step that was computed last and is not yet accepted, and the forces at its end.
    pub(super) fn write_work_of_step(&mut self) {
        let mut room = std::mem::take(&mut self.room);
        let (_, mut last) = std::mem::take(&mut self.work);
        last.forget();
        self.work = (self.work_of_step(&mut room, &mut last), last);
        self.room = room;
    }

    fn work_of_step(&self, room: &mut Room<T>, last: &mut LastForces<T>) -> StepWork {
        let Self { integrator, system, state, last_good: before, substep_dt: dt, kind, last_forces, .. } = self;
        let (is_damped, has_motion) = (system.is_damped(), system.dirichlet.has_motion());
        let [obstacles, friction] = self.work_of_obstacles();
        let mut work = StepWork { obstacles, friction, ..StepWork::default() };
        if let Some(of_stages) = integrator.work_of_stages() {
            work.motions = of_stages.motions + of_stages.jump;
            [work.rayleigh, work.dampers] = [of_stages.rayleigh, of_stages.dampers];
        } else if is_damped || has_motion {
            write_difference(&state.u, &before.u, &mut room.change);
            let evaluation = integrator.last_evaluation();
            if is_damped {
                [work.rayleigh, work.dampers] = self.work_of_damping(evaluation, room);
            }
            if has_motion {
                work.motions = self.work_of_motions(evaluation, room) + integrator.work_of_jump();
            }
            match evaluation {
                Some(_) if takes_forces_at_end(*kind) => {}
                Some(LastEvaluation { reactions, damping }) => {
                    last.reactions.clone_from(reactions);
                    last.damping.clone_from(damping);
                }
                None if has_motion => std::mem::swap(&mut last.reactions, &mut room.unbalanced.force),
                None => {}
            }
        }
        if system.forces.active().any(|(potential, _)| potential.is_relaxing()) {
            write_difference(&state.u, &before.u, &mut room.change);
            let mut against = |u: &[[T; 3]], time: f64| {
                forces_of(system, |potential| potential.is_relaxing(), (u, Moment::at(time)), &mut room.other);
                -dot(&room.other, &room.change)
            };
            let at_end = against(&state.u, before.time + dt);
            work.dampers += match takes_forces_at_end(*kind) {
                true => at_end,
                false => 0.5 * (at_end + against(&before.u, before.time)),
            };
        }
        if system.forces.active().any(|(potential, _)| is_changing_load(potential)) {
            forces_of(system, is_changing_load, (&state.u, Moment::at(before.time + dt)), &mut last.loads);
            write_difference(&state.u, &before.u, &mut room.change);
            work.loads = dot(&last.loads, &room.change);
            if !takes_forces_at_end(*kind) {
                let at_start = match last_forces.loads.is_empty() {
                    true => {
                        forces_of(system, is_changing_load, (&before.u, Moment::at(before.time)), &mut room.other);
                        &room.other
                    }
                    false => &last_forces.loads,
                };
                work.loads = 0.5 * (work.loads + dot(at_start, &room.change));
            }
        }
        work
    }

    /// Energies that Rayleigh damping and dampers dissipate in a step of an implicit method, J.
    fn work_of_damping(&self, evaluation: Option<&LastEvaluation<T>>, room: &mut Room<T>) -> [f64; 2] {
        let Self { system, state, last_good: before, substep_dt: dt, kind, last_forces, .. } = self;
        let is_known = takes_forces_at_end(*kind) || !last_forces.damping.is_empty();
        match evaluation.filter(|_| is_known) {
            // An evaluation has the sum of both forces.
            Some(LastEvaluation { damping, .. }) if system.damping.is_none() => {
                [0.0, self.work_of(damping, &last_forces.damping, &room.change)]
            }
            Some(LastEvaluation { damping, .. }) if !system.has_dampers() => {
                [self.work_of(damping, &last_forces.damping, &room.change), 0.0]
            }
            _ => {
                // Halfway the increment of a rotation strains nothing, as a step's own matrix of viscosity.
                let part = if system.has_viscosity() { 0.5 } else { 0.0 };
                write_between(&before.u, &state.u, part, &mut room.other);
                let powers = system.damping_powers(&room.other, &room.change, &mut room.unbalanced.force);
                powers.map(|power| power / dt)
            }
        }
    }

    /// Work of the reactions in a step of an implicit method, J. Where there is no evaluation, it leaves them in the room, N.
    fn work_of_motions(&self, evaluation: Option<&LastEvaluation<T>>, room: &mut Room<T>) -> f64 {
        let Self { integrator, system, state, last_good: before, substep_dt: dt, kind, last_forces, .. } = self;
        let Room { change, unbalanced, .. } = room;
        system.dirichlet.clear_free(change);
        if let Some(LastEvaluation { reactions, .. }) = evaluation {
            return self.work_of(reactions, &last_forces.reactions, change);
        }
        let end = End { time: before.time + dt, ..End::of(state) };
        match integrator.last_stage().filter(|_| !takes_forces_at_end(*kind)) {
            Some(stage) => unbalanced.at_stage(system, before, end, (stage.part, stage.acceleration)),
            None => unbalanced.at_end(system, before, end, Moment::at(end.time)),
        }
        self.work_of(&unbalanced.force, &last_forces.reactions, change)
    }

    /// Work of a force that is known at a step's stage, and perhaps at that of the last step, J: linear between the two, with its value
    /// halfway through the step.
    fn work_of(&self, force: &[[T; 3]], at_last: &[[T; 3]], change: &[[T; 3]]) -> f64 {
        let work = dot(force, change);
        if takes_forces_at_end(self.kind) || at_last.is_empty() {
            return work;
        }
        let part = self.integrator.last_stage().map_or(1.0, |stage| stage.part);
        (1.5 - part) * work + (part - 0.5) * dot(at_last, change)
    }

    /// Work of moving obstacles in a step, and the energy that friction on obstacles dissipates, J.
    fn work_of_obstacles(&self) -> [f64; 2] {
        let Some(contact) = self.contact.as_ref().filter(|contact| contact.does_work()) else { return [0.0; 2] };
        let times = [self.last_good.time, self.last_good.time + self.substep_dt];
        let mut work = [0.0; 2];
        self.each_contact_force(times, |on_node| {
            let (plane, node) = (&contact.planes().planes[on_node.plane], on_node.node);
            let travel = plane.displacement(times[1]) - plane.displacement(times[0]);
            let moved = triple(|i| (self.state.u[node][i] - self.last_good.u[node][i]).as_f64());
            work[0] += on_node.force.dot(&travel);
            work[1] -= on_node.force.dot(&Vector3::from(tangential(plane, moved, times)));
        });
        work
    }
}

/// Returns true if a method takes all forces at the end of a step.
fn takes_forces_at_end(kind: IntegratorKind) -> bool {
    !kind.is_explicit() && !kind.estimates_error()
}

/// Writes the sum of some forces at displacements and a moment, N.
fn forces_of<T: Real>(
    system: &System<T>,
    is_meant: impl Fn(&dyn Potential<T>) -> bool,
    (u, moment): (&[[T; 3]], Moment),
    force: &mut Vec<[T; 3]>,
) {
    set_zero(force, u.len());
    for (potential, _) in system.forces.active().filter(|(potential, _)| is_meant(*potential)) {
        potential.subtract_force(u, moment, force);
    }
    scale(-1.0, force);
}

/// Writes x − y.
fn write_difference<T: Real>(x: &[[T; 3]], y: &[[T; 3]], difference: &mut Vec<[T; 3]>) {
    difference.clear();
    difference.extend(x.iter().zip(y).map(|(x, y)| triple(|i| x[i] - y[i])));
}
