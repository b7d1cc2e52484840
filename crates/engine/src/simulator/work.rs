//! Works in one step that depend on the path: of loads that change or follow the body, of prescribed motions and of moving obstacles, and
//! the energy that damping and friction dissipate.
//!
//! Methods of first order take all forces at the end of a step, so their works are F₁ · Δu: then implicit Euler only loses energy. The
//! others take the mean of the forces at start and end, or those at their stage, which is exact for the trapezoidal and the midpoint
//! rule. Explicit methods sum the powers of damping and reactions at their stages. Obstacles act at the end of a step in all methods.

use std::ops::AddAssign;

use super::Simulator;
use super::energies::{Bounds, is_changing_load};
use crate::forces::Moment;
use crate::forces::contact::friction::tangential;
use crate::model::reactions::{End, Unbalanced, write_between};
use crate::model::system::System;
use fem_elements::Real;
use fem_elements::history::put;
use fem_elements::vector::{dot, scale, set_zero, triple};
use fem_model::Integrator as IntegratorKind;
use fem_model::simulation::History;
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
    /// Of the velocities.
    pub(super) bounds: Option<Bounds>,
}

impl<T: Real> LastForces<T> {
    /// Forgets them: the state or the forces are new.
    pub(super) fn forget(&mut self) {
        self.loads.clear();
        self.reactions.clear();
        self.bounds = None;
    }

    /// Adds them to a history.
    pub(super) fn save(&self, history: &mut History) {
        put(history, "ledger.load_forces", self.loads.as_flattened());
        put(history, "ledger.reactions", self.reactions.as_flattened());
    }

    /// Restores the forces that [`save`](Self::save) has added.
    pub(super) fn restore(&mut self, history: &History, nodes: usize) -> Result<(), String> {
        self.bounds = None;
        for (name, vector) in [("ledger.load_forces", &mut self.loads), ("ledger.reactions", &mut self.reactions)] {
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
    /// Change of the displacements in the step, m; that of constrained ones alone where reactions do work.
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
        } else if let Some(held) = integrator.held().filter(|_| !system.has_dampers() || system.damping.is_none()) {
            // Twice its energy, whole: of Rayleigh's damping or of dampers.
            let damped = if system.has_dampers() { &mut work.dampers } else { &mut work.rayleigh };
            *damped = if is_damped { 2.0 * held.damping } else { 0.0 };
            if has_motion {
                write_difference(&state.u, &before.u, &mut room.change);
                system.dirichlet.clear_free(&mut room.change);
                work.motions = dot(&held.reactions, &room.change);
            }
        } else {
            if is_damped {
                // Halfway the increment of a rotation strains nothing, as a step's own matrix of viscosity.
                let part = if system.has_viscosity() { 0.5 } else { 0.0 };
                write_between(&before.u, &state.u, part, &mut room.other);
                write_difference(&state.u, &before.u, &mut room.change);
                let powers = system.damping_powers(&room.other, &room.change, &mut room.unbalanced.force);
                [work.rayleigh, work.dampers] = powers.map(|power| power / dt);
            }
            if has_motion {
                work.motions = self.work_of_motions(room) + integrator.work_of_jump();
                std::mem::swap(&mut last.reactions, &mut room.unbalanced.force);
            }
        }
        if system.forces.active().any(|(potential, _)| is_changing_load(potential)) {
            forces_of_loads(system, &state.u, Moment::at(before.time + dt), &mut last.loads);
            write_difference(&state.u, &before.u, &mut room.change);
            work.loads = dot(&last.loads, &room.change);
            if !takes_forces_at_end(*kind) {
                let at_start = match last_forces.loads.is_empty() {
                    true => {
                        forces_of_loads(system, &before.u, Moment::at(before.time), &mut room.other);
                        &room.other
                    }
                    false => &last_forces.loads,
                };
                work.loads = 0.5 * (work.loads + dot(at_start, &room.change));
            }
        }
        work
    }

    /// Work of the reactions in a step of an implicit method, J. Leaves the reactions at its end or at its stage in the room, N.
    fn work_of_motions(&self, room: &mut Room<T>) -> f64 {
        let Self { integrator, system, state, last_good: before, substep_dt: dt, kind, last_forces, .. } = self;
        let Room { change, unbalanced, .. } = room;
        write_difference(&state.u, &before.u, change);
        system.dirichlet.clear_free(change);
        let end = End { time: before.time + dt, ..End::of(state) };
        let part = match integrator.last_stage().filter(|_| !takes_forces_at_end(*kind)) {
            Some(stage) => {
                unbalanced.at_stage(system, before, end, (stage.part, stage.acceleration));
                stage.part
            }
            None => {
                unbalanced.at_end(system, before, end, Moment::at(end.time));
                1.0
            }
        };
        let work = dot(&unbalanced.force, change);
        if takes_forces_at_end(*kind) || last_forces.reactions.is_empty() {
            return work;
        }
        // Linear between the stage of the last step and that of this one.
        (1.5 - part) * work + (part - 0.5) * dot(&last_forces.reactions, change)
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

/// Writes the forces of the loads whose work depends on the path, N.
fn forces_of_loads<T: Real>(system: &System<T>, u: &[[T; 3]], moment: Moment, force: &mut Vec<[T; 3]>) {
    set_zero(force, u.len());
    for (potential, _) in system.forces.active().filter(|(potential, _)| is_changing_load(*potential)) {
        potential.subtract_force(u, moment, force);
    }
    scale(-1.0, force);
}

/// Writes x − y.
fn write_difference<T: Real>(x: &[[T; 3]], y: &[[T; 3]], difference: &mut Vec<[T; 3]>) {
    difference.clear();
    difference.extend(x.iter().zip(y).map(|(x, y)| triple(|i| x[i] - y[i])));
}
