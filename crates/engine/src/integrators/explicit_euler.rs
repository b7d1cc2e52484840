//! Explicit Euler: u⁺ = u + dt v, v⁺ = v + dt a(u, v, t). First order; a motion without damping grows at any time step.

use super::accelerations::Accelerations;
use crate::forces::pulls::Pulls;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use crate::vector::axpy;
use fem_scene::simulation::{Cause, Counters};

/// Explicit Euler with its vectors.
pub struct ExplicitEuler<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
}

impl<T: Real> ExplicitEuler<T> {
    /// For a body.
    pub fn new(system: &System<T>) -> Self {
        Self { accelerations: Accelerations::new(system), a: vec![[T::default(); 3]; system.nodes()] }
    }

    /// One step. After an error the state is of no use.
    pub fn step(
        &mut self,
        pulls: &Pulls<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        self.accelerations.begin(pulls.system, state, dt);
        self.accelerations.at(pulls, (&state.u, &state.v), state.time, &mut self.a, counters)?;
        axpy(dt, &state.v, &mut state.u);
        axpy(dt, &self.a, &mut state.v);
        Ok(())
    }
}
