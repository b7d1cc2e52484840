//! The explicit midpoint rule, Runge (1895): a half step of explicit Euler, and a whole one with the slopes found there. Second
//! order; a motion without damping grows, though slowly.

use fem_model::simulation::{Cause, Counters};

use super::{Accelerations, Convergence, Integrator, Memoryless, Stage, StageWork};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::axpy;
use fem_solvers::Real;

/// The midpoint rule with its vectors.
pub struct Rk2<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
    u: Vec<[T; 3]>,
    v: Vec<[T; 3]>,
}

impl<T: Real> Rk2<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self { accelerations: Accelerations::new(system), a: zero(), u: zero(), v: zero() }
    }
}

impl<T: Real> Memoryless for Rk2<T> {}

impl<T: Real> Integrator<T> for Rk2<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { accelerations, a, u, v } = self;
        let half = 0.5 * dt;
        accelerations.begin(system, state, dt, a)?;
        let start = Stage { after: 0.0, weight: 0.0 };
        accelerations.at(system, (&mut state.u, &mut state.v), start, a, counters)?;
        u.copy_from_slice(&state.u);
        v.copy_from_slice(&state.v);
        axpy(half, &state.v, u);
        axpy(half, a, v);
        accelerations.at(system, (u, v), Stage { after: 0.5, weight: 1.0 }, a, counters)?;
        accelerations.dissipate(v, 1.0);
        axpy(dt, v, &mut state.u);
        axpy(dt, a, &mut state.v);
        accelerations.end(system, state);
        Ok(Convergence::Converged)
    }

    fn work_of_stages(&self) -> Option<StageWork> {
        Some(self.accelerations.work())
    }
}
