//! The classical Runge–Kutta method, Kutta (1901): fourth order; stable for ω dt < 2√2 of the fastest vibration.

use fem_model::simulation::{Cause, Counters};

use super::{Accelerations, Convergence, Integrator, Memoryless, Stage, StageWork};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::axpy;
use fem_solvers::Real;

/// The classical method with its vectors.
pub struct Rk4<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
    u: Vec<[T; 3]>,
    v: Vec<[T; 3]>,
    /// Displacements and velocities at the start.
    start: [Vec<[T; 3]>; 2],
}

const STAGES: [Stage; 4] = [
    Stage { after: 0.0, weight: 1.0 / 6.0 },
    Stage { after: 0.5, weight: 1.0 / 3.0 },
    Stage { after: 0.5, weight: 1.0 / 3.0 },
    Stage { after: 1.0, weight: 1.0 / 6.0 },
];

impl<T: Real> Rk4<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self { accelerations: Accelerations::new(system), a: zero(), u: zero(), v: zero(), start: [zero(), zero()] }
    }
}

impl<T: Real> Memoryless for Rk4<T> {}

impl<T: Real> Integrator<T> for Rk4<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { accelerations, a, u, v, start: [u0, v0] } = self;
        accelerations.begin(system, state, dt, a)?;
        for (copy, of) in [(&mut *u, &state.u), (&mut *v, &state.v), (&mut *u0, &state.u), (&mut *v0, &state.v)] {
            copy.copy_from_slice(of);
        }
        for (number, stage) in STAGES.into_iter().enumerate() {
            accelerations.at(system, (u, v), stage, a, counters)?;
            accelerations.dissipate(v, stage.weight);
            axpy(stage.weight * dt, v, &mut state.u);
            axpy(stage.weight * dt, a, &mut state.v);
            // Where the next stage is.
            let Some(Stage { after, .. }) = STAGES.get(number + 1) else { break };
            u.copy_from_slice(u0);
            axpy(after * dt, v, u);
            v.copy_from_slice(v0);
            axpy(after * dt, a, v);
        }
        accelerations.end(system, state);
        Ok(Convergence::Converged)
    }

    fn work_of_stages(&self) -> Option<StageWork> {
        Some(self.accelerations.work())
    }
}
