//! One step: its substeps, and what a state must keep to.

use fem_scene::simulation::{Cause, Failure};

use super::Simulator;
use crate::integrators::Convergence;
use crate::model::system::System;
use crate::number::Real;

/// From this many nodes on several threads share the work of a step.
const NODES_FOR_THREADS: usize = 2000;

impl<T: Real> Simulator<T> {
    /// Advances by one step. The work of a large body runs inside the thread pool, so that no loop has to enter it.
    pub(super) fn advance_step(&mut self) -> Result<(), Failure> {
        if self.system.nodes() < NODES_FOR_THREADS {
            return self.step_here();
        }
        let mut outcome = Ok(());
        rayon::scope(|_| outcome = self.step_here());
        outcome
    }

    fn step_here(&mut self) -> Result<(), Failure> {
        let mut convergence = Convergence::Converged;
        for _ in 0..self.substeps {
            if self.substep()? == Convergence::NotConverged {
                convergence = Convergence::NotConverged;
            }
        }
        self.counters.unconverged_steps += usize::from(convergence == Convergence::NotConverged);
        self.counters.steps += 1;
        self.state.steps += 1;
        Ok(())
    }

    /// Advances by one substep, which leaves the state as it was if it fails.
    fn substep(&mut self) -> Result<Convergence, Failure> {
        if self.apply_conditions_at(self.state.time) {
            self.integrator.forget();
        }
        let Self { integrator, system, state, substep_dt: dt, last_good, .. } = self;
        last_good.copy_from(state);
        let moment = integrator.moment(state);
        system.forces.begin_step(&state.u, moment, *dt);
        let outcome = self.advance();
        match outcome.and_then(|convergence| self.check_state().map(|()| convergence)) {
            Ok(convergence) => {
                self.flow();
                self.state.time = self.last_good.time + self.substep_dt;
                Ok(convergence)
            }
            Err(cause) => {
                self.state.copy_from(&self.last_good);
                self.forget();
                Err(self.failure(cause))
            }
        }
    }

    /// Whether the state that a step has reached is finite, has no inverted element, unless the law allows that, and no more energy
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
