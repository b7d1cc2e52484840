//! Substeps: one is computed, and accepted or undone.

use fem_scene::simulation::{Cause, Failure};

use super::Simulator;
use crate::integrators::Convergence;
use crate::model::system::System;
use fem_elements::Real;

/// Smallest part of a substep with inverted elements that is tried.
const SMALLEST: f64 = 1.0 / 64.0;

impl<T: Real> Simulator<T> {
    /// Advances by one step in equal substeps.
    pub(super) fn equal_substeps(&mut self) -> Result<Convergence, Failure> {
        let mut convergence = Convergence::Converged;
        for _ in 0..self.substeps {
            let outcome = match self.try_substep() {
                Ok(outcome) => {
                    self.accept();
                    outcome
                }
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
        is_within && matches!(cause, Cause::Inverted { .. })
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
                    self.accept();
                    convergence = if outcome == Convergence::NotConverged { outcome } else { convergence };
                    self.state.time = if self.substep_dt == left { end } else { self.state.time };
                }
                Err(Cause::Inverted { .. }) if part > SMALLEST * whole => {
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
        let Self { integrator, supplied, system, state, last_good, substep_dt: dt, .. } = self;
        let ended_far_off =
            integrator.may_stop_early() && supplied.is_exceeded(system, &**integrator, last_good, state, *dt);
        Ok(if ended_far_off { Convergence::NotConverged } else { convergence })
    }

    /// Accepts the substep that was computed: the material flows, and time goes on.
    pub(super) fn accept(&mut self) {
        self.integrator.accept();
        self.flow();
        self.state.time = self.last_good.time + self.substep_dt;
        if self.system.forces.has_lag()
            && let Some(contact) = &mut self.contact
        {
            contact.end_step(&self.last_good, &self.state);
        }
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
        }
        self.check_contact()?;
        if self.integrator.is_unconditionally_stable() || self.supplied.may_diverge {
            return Ok(());
        }
        self.supplied.check(&self.system, &*self.integrator, &self.last_good, &self.state, self.substep_dt)
    }

    /// Lets the material flow in a step that has been accepted.
    fn flow(&mut self) {
        let Self { system: System { elements, profile, .. }, state, substep_dt: dt, .. } = self;
        if elements.plasticity().is_some() {
            profile.plasticity.time(|| elements.flow(&state.u, *dt));
        }
    }

    fn failure(&self, cause: Cause) -> Failure {
        Failure::of_step(self.state.steps, self.state.time, self.substep_dt, self.kind, cause)
    }
}
