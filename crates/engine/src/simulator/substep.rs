//! Substeps: one is computed, and accepted or undone.

use fem_model::Integrator as IntegratorKind;
use fem_model::simulation::{Cause, Failure};

use super::Simulator;
use super::energies::Bounds;
use super::ledger::{Ledger, Step};
use super::work::LastForces;
use crate::integrators::Convergence;
use crate::model::system::System;
use fem_solvers::Real;

/// Smallest part of a substep with inverted elements that is tried.
const SMALLEST: f64 = 1.0 / 64.0;

/// Steps of an explicit method from one check of the corners to the next: a check takes half as long as such a step.
const CORNERS: usize = 8;

impl<T: Real> Simulator<T> {
    /// Advances by one step in equal substeps.
    pub(super) fn equal_substeps(&mut self) -> Result<Convergence, Failure> {
        let mut convergence = Convergence::Converged;
        for _ in 0..self.substeps {
            let outcome = match self.try_substep() {
                Ok(outcome) => self.accept(outcome)?,
                Err(cause) if self.is_inverted_beyond_the_stage(cause) => self.in_smaller_parts()?,
                Err(cause) => return Err(self.fail(cause)),
            };
            if outcome == Convergence::NotConverged {
                convergence = Convergence::NotConverged;
            }
        }
        Ok(convergence)
    }

    /// Returns true if a step failed because of elements that are inverted at its end, and the method evaluates its forces before the end.
    fn is_inverted_beyond_the_stage(&self, cause: Cause) -> bool {
        let is_within = self.integrator.last_stage().is_some_and(|stage| stage.part < 1.0);
        is_within && cause.is_inversion()
    }

    /// Computes a substep that has inverted elements in smaller parts.
    fn in_smaller_parts(&mut self) -> Result<Convergence, Failure> {
        let (whole, end) = (self.substep_dt, self.last_good.time + self.substep_dt);
        self.state.copy_from(&self.last_good);
        let (mut part, mut convergence) = (0.5 * whole, Convergence::Converged);
        while self.state.time < end {
            let left = end - self.state.time;
            self.substep_dt = if part < 0.999 * left { part } else { left };
            match self.try_substep() {
                Ok(outcome) => {
                    let accepted = self.accept(outcome).inspect_err(|_| self.substep_dt = whole)?;
                    convergence = if accepted == Convergence::NotConverged { accepted } else { convergence };
                    self.state.time = if self.substep_dt == left { end } else { self.state.time };
                }
                Err(cause) if cause.is_inversion() && part > SMALLEST * whole => {
                    self.counters.rejected_steps += 1;
                    self.state.copy_from(&self.last_good);
                    part *= 0.5;
                }
                Err(cause) => {
                    let failure = self.fail(cause);
                    self.substep_dt = whole;
                    return Err(failure);
                }
            }
        }
        self.substep_dt = whole;
        Ok(convergence)
    }

    /// Computes one substep, at whose end the state is; the time is still that of its start.
    pub(super) fn try_substep(&mut self) -> Result<Convergence, Cause> {
        if self.apply_conditions_at(self.state.time) {
            self.integrator.forget();
        }
        let Self { integrator, system, state, substep_dt: dt, last_good, contact, .. } = self;
        last_good.copy_from(state);
        if let Some(contact) = contact {
            contact.begin_step(&state.u);
        }
        let moment = integrator.moment(state);
        system.forces.begin_step(&state.u, moment, *dt);
        let convergence = self.advance()?;
        self.check_state()?;
        Ok(convergence)
    }

    /// The failure of a run whose last steps, which no check has seen yet, have inverted an element at a corner or gained energy that nothing
    /// explains.
    pub(super) fn failure_at_end_now(&self) -> Option<Failure> {
        if let Err(cause) = self.check_corners() {
            return Some(self.failure(cause));
        }
        let is_staggered = self.integrator.has_staggered_velocities();
        let mut ledger = self.ledger.clone();
        if is_staggered {
            ledger = ledger.without(&self.work.0);
        }
        let is_due = is_judged(self.kind) && !self.integrator.may_stop_early() && ledger.has_steps();
        let mut room = Vec::new();
        (is_due && ledger.judge(&mut self.last_step(&self.last_forces, &mut room)))
            .then(|| self.failure(ledger.cause()))
    }

    /// Accepts the substep that was computed: the material flows, time goes on, and the energy is judged. After a failure the state is that at
    /// the end of the substep.
    pub(super) fn accept(&mut self, convergence: Convergence) -> Result<Convergence, Failure> {
        let is_staggered = self.integrator.has_staggered_velocities();
        let mut has_gained = is_staggered && self.judge();
        self.integrator.accept();
        self.flow();
        self.state.time = self.last_good.time + self.substep_dt;
        if self.system.forces.has_lag()
            && let Some(contact) = &mut self.contact
        {
            contact.end_step(&self.last_good, &self.state);
        }
        self.ledger.add(&self.work.0);
        let were_known = !self.last_forces.reactions.is_empty();
        std::mem::swap(&mut self.last_forces, &mut self.work.1);
        if !were_known && !self.last_forces.reactions.is_empty() {
            self.with_ledger(|simulator| &simulator.last_forces, |ledger, step| ledger.explain_jump(step));
        }
        has_gained |= !is_staggered && self.judge();
        match has_gained {
            false => Ok(convergence),
            true if self.integrator.may_stop_early() => Ok(Convergence::NotConverged),
            true => Err(self.failure(self.ledger.cause())),
        }
    }

    /// Judges the energy of a step if the method is due for that. Returns true if energy has been gained that nothing explains.
    fn judge(&mut self) -> bool {
        let is_due = is_judged(self.kind) && self.ledger.is_due(&*self.integrator, self.kind.is_explicit());
        is_due && self.with_ledger(|simulator| &simulator.last_forces, |ledger, step| ledger.judge(step))
    }

    /// Calls `f` with the ledger and the last step, at whose end there are these forces.
    fn with_ledger<A>(
        &mut self,
        forces: impl FnOnce(&Self) -> &LastForces<T>,
        f: impl FnOnce(&mut Ledger, &mut Step<T>) -> A,
    ) -> A {
        let (mut ledger, mut room) = (std::mem::take(&mut self.ledger), std::mem::take(&mut self.room.other));
        let answer = f(&mut ledger, &mut self.last_step(forces(self), &mut room));
        (self.ledger, self.room.other) = (ledger, room);
        answer
    }

    /// The last step for the ledger, at whose end there are these forces.
    fn last_step<'a>(&'a self, forces: &'a LastForces<T>, room: &'a mut Vec<[T; 3]>) -> Step<'a, T> {
        let Self { integrator, system, state, last_good: before, substep_dt: dt, work, .. } = self;
        let (integrator, loads) = (&**integrator, &forces.loads);
        Step { system, integrator, before, state, dt: *dt, loads, work: &work.0, room }
    }

    /// Returns to the state before a substep that has failed.
    pub(super) fn fail(&mut self, cause: Cause) -> Failure {
        self.state.copy_from(&self.last_good);
        self.forget();
        self.failure(cause)
    }

    /// Checks that the state after a step is finite, has no inverted element unless the law allows that, and no more energy
    /// than it can have.
    fn check_state(&mut self) -> Result<(), Cause> {
        if let Some(node) = self.state.first_not_finite() {
            return Err(Cause::NotFinite { node: self.system.numbering.mesh_node[node] as usize });
        }
        if !self.system.elements.allow_inversion() {
            let (J, element) = self.system.elements.min_det_F_of_barriers(&self.state.u);
            Cause::inverted((J.as_f64(), element)).map_or(Ok(()), Err)?;
            if !self.kind.is_explicit() || self.counters.steps.is_multiple_of(CORNERS) {
                self.check_corners()?;
            }
        }
        self.check_contact()?;
        if !is_judged(self.kind) {
            return Ok(());
        }
        self.ledger.open(&self.system, &self.last_good);
        self.write_work_of_step();
        let Self { system, state, last_good, last_forces, work: (_, forces), .. } = self;
        let start = last_forces.bounds.unwrap_or_else(|| Bounds::of(system, last_good));
        let end = *forces.bounds.insert(Bounds::of(system, state));
        let leap = self.with_ledger(|simulator| &simulator.work.1, |ledger, step| ledger.leap(step, [start, end]));
        leap.map_or(Ok(()), Err)
    }

    /// Checks that no quadratic element is inverted at a corner, unless its law allows that.
    fn check_corners(&self) -> Result<(), Cause> {
        let (J, element) = self.corners.least(&self.system, &self.state.u);
        if J <= 0.0 { Err(Cause::InvertedAtCorner { element, J }) } else { Ok(()) }
    }

    /// Lets the material flow in a step that has been accepted.
    fn flow(&mut self) {
        let Self { system: System { elements, profile, .. }, state, substep_dt: dt, .. } = self;
        if elements.plasticity().is_some() {
            profile.plasticity.time(|| elements.flow(&state.u, *dt));
        }
    }

    fn failure(&self, cause: Cause) -> Failure {
        Failure::of_step(self.state.steps, self.last_good.time, self.substep_dt, self.kind, cause)
    }
}

/// Returns true for a method whose energy is that of the body: statics has no motion, and position-based dynamics no moduli.
pub(super) fn is_judged(kind: IntegratorKind) -> bool {
    !matches!(kind, IntegratorKind::Static | IntegratorKind::Pbd)
}
