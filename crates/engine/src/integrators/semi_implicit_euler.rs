//! Semi-implicit (symplectic) Euler: v⁺ = v + dt a(u, v, t), u⁺ = u + dt v⁺. First order; stable for ω dt < 2 of the fastest
//! vibration, and its energy then swings about the right one for ever, Hairer, Lubich, Wanner, Geometric Numerical Integration
//! (2006), I.1.2.

use super::accelerations::Accelerations;
use crate::forces::pulls::Pulls;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use crate::vector::axpy;
use fem_scene::simulation::{Cause, Counters};

/// Semi-implicit Euler with its vectors.
pub struct SemiImplicitEuler<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
}

impl<T: Real> SemiImplicitEuler<T> {
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
        axpy(dt, &self.a, &mut state.v);
        axpy(dt, &state.v, &mut state.u);
        Ok(())
    }
}
