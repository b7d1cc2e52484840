//! Explicit Euler: u⁺ = u + dt v, v⁺ = v + dt a(u, v, t). First order; without damping a motion grows at any time step.

use fem_model::simulation::{Cause, Counters};

use super::{Accelerations, Convergence, Integrator, Memoryless, Stage, StageWork};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::axpy;
use fem_solvers::Real;

/// Explicit Euler with its vectors.
pub struct ExplicitEuler<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
}

impl<T: Real> ExplicitEuler<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        Self { accelerations: Accelerations::new(system), a: vec![[T::default(); 3]; system.nodes()] }
    }
}

impl<T: Real> Memoryless for ExplicitEuler<T> {}

impl<T: Real> Integrator<T> for ExplicitEuler<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { accelerations, a } = self;
        accelerations.begin(system, state, dt, a)?;
        accelerations.at(system, (&mut state.u, &mut state.v), Stage { after: 0.0, weight: 1.0 }, a, counters)?;
        accelerations.dissipate(&state.v, 1.0);
        axpy(dt, &state.v, &mut state.u);
        axpy(dt, a, &mut state.v);
        accelerations.end(system, state);
        Ok(Convergence::Converged)
    }

    fn work_of_stages(&self) -> Option<StageWork> {
        Some(self.accelerations.work())
    }
}
