//! Checks of a state that a graphics device has computed.

use fem_model::simulation::{Failure, Simulation};

use super::Simulator;
use super::compiled::Compiled;

impl<T: Compiled> Simulator<T> {
    /// Takes one step from a state that a device has reached from the state now, by `steps` steps under loads whose work depends on the
    /// displacements alone. The step is checked like any other: a motion that has grown without bound is a failure. Displacements (m) and
    /// velocities (m/s) are in the mesh's numbering. Returns whether it has converged.
    pub(crate) fn step_from(&mut self, steps: usize, u: &[[f64; 3]], v: &[[f64; 3]]) -> Result<bool, Failure> {
        let start = self.state.clone();
        self.set_state(u, v);
        (self.state.time, self.state.steps) = (start.time + steps as f64 * self.dt, start.steps + steps);
        self.ledger.open(&self.system, &start);
        let before = self.counters.unconverged_steps;
        self.step()?;
        Ok(self.counters.unconverged_steps == before)
    }
}
