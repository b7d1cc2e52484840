//! One step of the simulation, in substeps of equal or of adapted size.

use fem_model::simulation::Failure;

use super::Simulator;
use crate::integrators::Convergence;
use fem_solvers::Real;

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
        let convergence = if self.is_adaptive() { self.adaptive_step()? } else { self.equal_substeps()? };
        self.counters.unconverged_steps += usize::from(convergence == Convergence::NotConverged);
        self.counters.steps += 1;
        self.state.steps += 1;
        Ok(())
    }
}
