//! Semi-implicit (symplectic) Euler: v⁺ = v + dt a(u, v, t), u⁺ = u + dt v⁺. First order; stable for ω dt < 2 of the fastest
//! vibration, where its energy oscillates about the exact one for all time, Hairer, Lubich, Wanner, Geometric Numerical Integration
//! (2006), I.1.2.

use fem_model::simulation::{Cause, Counters};

use super::{Accelerations, Convergence, Integrator, Memoryless, Stage, StageWork};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::axpy;
use fem_solvers::Real;

/// Semi-implicit Euler with its vectors.
pub struct SemiImplicitEuler<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
}

impl<T: Real> SemiImplicitEuler<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        Self { accelerations: Accelerations::new(system), a: vec![[T::default(); 3]; system.nodes()] }
    }
}

impl<T: Real> Memoryless for SemiImplicitEuler<T> {}

impl<T: Real> Integrator<T> for SemiImplicitEuler<T> {
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
        // The mean of the velocities half a step before and after.
        accelerations.dissipate(&state.v, 0.5);
        axpy(dt, a, &mut state.v);
        accelerations.dissipate(&state.v, 0.5);
        axpy(dt, &state.v, &mut state.u);
        accelerations.end(system, state);
        Ok(Convergence::Converged)
    }

    fn has_staggered_velocities(&self) -> bool {
        true
    }

    fn work_of_stages(&self) -> Option<StageWork> {
        Some(self.accelerations.work())
    }
}
