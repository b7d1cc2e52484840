//! Contact in a simulation: steps that keep the body outside its obstacles, and the forces of the obstacles.

use fem_model::simulation::{Cause, History, Plane, PlaneContact};
use fem_model::{Body, ContactPlane, ContactTreatment, Timer};
use nalgebra::Vector3;

use super::Simulator;
use super::creep::Creep;
use crate::forces::contact::barrier::Barrier;
use crate::forces::contact::friction::{norm, slope_over_y, tangential};
use crate::forces::contact::planes::Planes;
use crate::forces::contact::start::{Obstacles, Stand};
use crate::integrators::{Convergence, Impulses, PlaneContacts};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::history::{put, take};
use fem_elements::vector::triple;
use fem_solvers::Real;

/// Relative change of lagged forces at which they no longer change, and the one up to which they may change by rounding error.
const CONVERGED: f64 = 1e-6;
const ROUNDING: f64 = 1e-3;

/// Largest number of repetitions of a step.
const REPETITIONS: usize = 100;

/// Largest number of repetitions in which Newton's method may end early; the next one continues from its result.
const UNCONVERGED: usize = 5;

/// Repetitions after which half of the change of lagged forces is applied, then a quarter, and so on, because some oscillate.
const PATIENCE: usize = 15;

/// Depth of a node behind a plane that is rounding error, in lengths of the body.
const DEPTH: f64 = 1e-9;

/// The obstacles of a simulation.
pub(super) struct Contacts<T: Real> {
    planes: Planes,
    barrier: Barrier,
    /// m/s
    transition_speed: f64,
    /// Impulses in place of the barrier, for explicit methods.
    impulses: Option<Impulses<T>>,
    /// The planes that stand back from the scene's place.
    stands: Vec<Stand>,
    creep: Creep,
    /// Largest relative change that lagged forces were left with in a step.
    residual: f64,
    /// Calls and time of the impulses.
    pub(super) timer: Timer,
}

/// The force of an obstacle on a node, N.
pub(super) struct NodeForce {
    pub plane: usize,
    pub node: usize,
    pub force: Vector3<f64>,
}

impl<T: Real> Contacts<T> {
    /// The obstacles of a body; `None` if the scene has none.
    pub(super) fn new(body: Option<&Body>, system: &mut System<T>) -> Option<Self> {
        let contact = body?.contact.as_ref()?;
        let Obstacles { planes, barrier, stands } = Obstacles::new(body?, &system.numbering)?;
        if contact.treatment == ContactTreatment::Projection {
            system.contact_force = vec![[T::default(); 3]; system.nodes()];
        }
        Some(Self {
            impulses: Impulses::new(planes.clone(), contact.treatment, system),
            barrier,
            transition_speed: contact.transition_speed,
            planes,
            stands,
            creep: Creep::default(),
            residual: 0.0,
            timer: Timer::default(),
        })
    }

    /// The planes.
    pub(super) fn planes(&self) -> &Planes {
        &self.planes
    }

    /// Returns true if a plane moves or has friction.
    pub(super) fn does_work(&self) -> bool {
        self.planes.planes.iter().any(|plane| plane.friction > 0.0 || !plane.is_at_rest())
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> usize {
        let impulses = self.impulses.as_ref().map_or(0, |impulses| impulses.bytes());
        self.planes.bytes() + self.barrier.bytes() + impulses
    }

    /// Adds the data of the last steps that reports need.
    pub(super) fn save(&self, history: &mut History) {
        put(history, "contact.residual", &[self.residual]);
        self.creep.save(history);
        if let Some(impulses) = &self.impulses {
            impulses.save(history);
        }
    }

    /// Restores the data that [`save`](Self::save) has added; steps last `dt` seconds.
    pub(super) fn restore(&mut self, history: &History, system: &mut System<T>, dt: f64) -> Result<(), String> {
        take(history, "contact.residual", std::slice::from_mut(&mut self.residual))?;
        self.creep.restore(history)?;
        let Some(impulses) = &mut self.impulses else { return Ok(()) };
        impulses.restore(history)?;
        impulses.write_forces(system, dt);
        Ok(())
    }

    /// Prepares a step from these displacements, m.
    pub(super) fn begin_step(&mut self, u: &[[T; 3]]) {
        self.barrier.begin_step(u);
    }

    /// Drops the forces of the last step: the state is a new one, with these displacements, m.
    pub(super) fn forget(&mut self, system: &mut System<T>, u: &[[T; 3]]) {
        self.begin_step(u);
        (self.residual, self.creep) = (0.0, Creep::default());
        system.contact_force.fill([T::default(); 3]);
        if let Some(impulses) = &mut self.impulses {
            impulses.forget();
        }
    }

    /// Takes note of the sliding in a step that has been accepted, with lagged friction.
    pub(super) fn end_step(&mut self, before: &State<T>, after: &State<T>) {
        self.creep.add((&self.planes, &self.barrier), self.transition_speed, before, after);
    }

    /// The warning of a run whose friction was smaller than Coulomb's, if it was.
    pub(super) fn warning(&self) -> Option<String> {
        self.creep.warning(self.transition_speed, self.barrier.distance)
    }

    /// The planes that stand back, a line each.
    pub(super) fn notes(&self) -> Vec<String> {
        let stand = |&Stand { plane, distance, force, energy }: &Stand| {
            format!(
                "planes[{plane}] is nearer to the body than its barrier's reach of {:.3e} m, so it stands back by {distance:.3e} m: there \
                 the barrier bears the body with {force:.3e} N and stores {energy:.3e} J",
                self.barrier.distance
            )
        };
        self.stands.iter().map(stand).collect()
    }

    /// The first plane with a node behind it, the deepest such node and its depth (m), in the engine's numbering.
    pub(super) fn penetration(&self, u: &[[T; 3]], time: f64, length: f64) -> Option<(usize, usize, f64)> {
        let nearest = (0..self.planes.planes.len()).map(|plane| self.planes.nearest(plane, u, time));
        // NaN fails the comparison.
        nearest.filter(|near| !(near.gap >= -DEPTH * length)).map(|near| (near.plane, near.node, -near.gap)).next()
    }
}

impl<T: Real> Simulator<T> {
    /// Advances the state by one step, outside the obstacles. A step with lagged forces is repeated until they no longer change.
    pub(super) fn advance(&mut self) -> Result<Convergence, Cause> {
        if self.system.forces.has_lag() {
            return self.advance_with_lag();
        }
        let Self { integrator, system, state, substep_dt: dt, counters, last_good, contact, kind, .. } = self;
        let convergence = integrator.step(system, state, *dt, counters)?;
        if let Some(contacts) = integrator.plane_contacts() {
            write_contact_forces(contacts, &mut system.contact_force);
        }
        let Some(Contacts { impulses: Some(impulses), timer, .. }) = contact else { return Ok(convergence) };
        if timer.time(|| impulses.apply(system, last_good, state, (*kind, *dt))) {
            // Places have changed, and with them the forces at the end of the step.
            integrator.forget_forces();
        }
        Ok(convergence)
    }

    /// The initial guess of a repetition assumes the change of velocity of the one before, so it starts at that one's end.
    fn advance_with_lag(&mut self) -> Result<Convergence, Cause> {
        let Self { integrator, system, state, substep_dt: dt, counters, last_good, contact, .. } = self;
        let (mut before, mut unconverged) = (f64::INFINITY, 0);
        for repetition in 1.. {
            let convergence = integrator.step(system, state, *dt, counters)?;
            let relaxation = 0.5f64.powi((repetition / PATIENCE) as i32);
            let change = system.forces.update_lag(&state.u, relaxation);
            let is_rounding = change < ROUNDING && change >= before;
            let is_converged = convergence == Convergence::Converged;
            unconverged += usize::from(!is_converged);
            let is_last = repetition == REPETITIONS || unconverged > UNCONVERGED;
            if (is_converged && (change <= CONVERGED || is_rounding)) || is_last {
                // Reports take the forces at the end of the step.
                system.forces.update_lag(&state.u, 1.0);
                if let Some(contact) = contact {
                    contact.residual = contact.residual.max(change);
                }
                return Ok(if change < ROUNDING { convergence } else { Convergence::NotConverged });
            }
            before = change;
            state.copy_from(last_good);
        }
        unreachable!("the last repetition returns")
    }

    /// Passes on the force of each obstacle on each node near it in a step between two times (s), in the engine's numbering.
    pub(super) fn each_contact_force(&self, times: [f64; 2], pass: impl FnMut(NodeForce)) {
        let Self { contact: Some(contact), state, last_good, substep_dt: dt, .. } = self else { return };
        if let Some(impulses) = &contact.impulses {
            let of_impulse = |impulse: &crate::integrators::Impulse| NodeForce {
                plane: impulse.plane,
                node: impulse.node,
                force: impulse.total(contact.planes.planes[impulse.plane].normal) / *dt,
            };
            return impulses.impulses().iter().map(of_impulse).for_each(pass);
        }
        if let Some(contacts) = self.integrator.plane_contacts() {
            return contacts.forces().map(|(plane, node, force)| NodeForce { plane, node, force }).for_each(pass);
        }
        let transition = contact.transition_speed * dt;
        let near = contact.planes.near(&state.u, times[1], contact.barrier.distance);
        let force = |near: crate::forces::contact::planes::Near| {
            let plane = &contact.planes.planes[near.plane];
            let normal = contact.barrier.force(contact.barrier.area(near.plane, near.node), near.gap);
            let moved = triple(|i| (state.u[near.node][i] - last_good.u[near.node][i]).as_f64());
            let slide = tangential(plane, moved, times);
            let factor = plane.friction * normal * slope_over_y(norm(slide), transition);
            let friction = if plane.friction > 0.0 { Vector3::from(slide) * factor } else { Vector3::zeros() };
            NodeForce { plane: near.plane, node: near.node, force: plane.normal * normal - friction }
        };
        near.map(force).for_each(pass);
    }

    /// The force of each obstacle on the body, and the distance of the nearest node.
    pub(super) fn contacts_now(&self) -> Vec<PlaneContact> {
        let Some(contact) = &self.contact else { return Vec::new() };
        let mut forces = vec![Vector3::zeros(); contact.planes.planes.len()];
        self.each_contact_force([self.last_good.time, self.state.time], |on_node| {
            forces[on_node.plane] += on_node.force
        });
        let of_plane = |(plane, force): (usize, Vector3<f64>)| PlaneContact {
            name: format!("planes[{plane}]"),
            force: force.into(),
            smallest_gap: contact.planes.nearest(plane, &self.state.u, self.state.time).gap,
        };
        forces.into_iter().enumerate().map(of_plane).collect()
    }

    /// The obstacles where they are now.
    pub(super) fn planes_now(&self) -> Vec<Plane> {
        let planes = self.contact.iter().flat_map(|contact| &contact.planes.planes);
        let now = |plane: &ContactPlane| Plane {
            point: plane.point + plane.displacement(self.state.time),
            normal: plane.normal,
        };
        planes.map(now).collect()
    }

    /// The force of all obstacles on each node, in the mesh's numbering, N; `None` without obstacles.
    pub(super) fn contact_forces_now(&self) -> Option<Vec<[f64; 3]>> {
        self.contact.as_ref()?;
        let mut forces = vec![[0.0; 3]; self.system.nodes()];
        self.each_contact_force([self.last_good.time, self.state.time], |NodeForce { node, force, .. }| {
            (0..3).for_each(|i| forces[node][i] += force[i]);
        });
        Some(self.system.numbering.to_mesh(&forces))
    }

    /// Largest relative change that the normal forces of friction were left with in a step; `None` without lagged forces.
    pub(super) fn lag_residual_now(&self) -> Option<f64> {
        self.system.forces.has_lag().then_some(self.contact.as_ref()?.residual)
    }

    /// Checks that the state lies outside all obstacles.
    pub(super) fn check_contact(&self) -> Result<(), Cause> {
        let Some(contact) = &self.contact else { return Ok(()) };
        let time = self.last_good.time + self.substep_dt;
        match contact.penetration(&self.state.u, time, self.system.length) {
            Some((plane, node, depth)) => {
                let node = self.system.numbering.mesh_node[node] as usize;
                Err(Cause::Penetrated { plane, node, depth })
            }
            None => Ok(()),
        }
    }
}

/// Makes the forces of planes on nodes those of the last step, for reports.
fn write_contact_forces<T: Real>(contacts: &PlaneContacts, forces: &mut [[T; 3]]) {
    forces.fill([T::default(); 3]);
    for (_, node, force) in contacts.forces() {
        for i in 0..3 {
            forces[node][i] += T::of(force[i]);
        }
    }
}
