//! Velocity Verlet, Swope et al. (1982): half a kick, a drift, half a kick. Second order; stable for ω dt < 2 of the fastest
//! vibration; symplectic without damping.

use super::accelerations::Accelerations;
use crate::forces::pulls::{AnchorSpring, Pulls};
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use crate::vector::axpy;
use fem_scene::simulation::{Cause, Counters};

/// Velocity Verlet with its vectors.
pub struct Verlet<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
    v: Vec<[T; 3]>,
    /// The pulls at the start of a step.
    springs: Vec<AnchorSpring<T>>,
    /// Whether `a` is that at the end of the last step.
    is_known: bool,
}

impl<T: Real> Verlet<T> {
    /// For a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let accelerations = Accelerations::new(system);
        Self { accelerations, a: zero(), v: zero(), springs: Vec::new(), is_known: false }
    }

    /// What is known from the last step is of no use any more.
    pub fn forget(&mut self) {
        self.is_known = false;
    }

    /// One step. After an error the state is of no use.
    pub fn step(
        &mut self,
        pulls: &Pulls<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let Self { accelerations, a, v, springs, is_known } = self;
        let half = 0.5 * dt;
        accelerations.begin(pulls.system, state, dt);
        pulls.at(state.time, springs);
        if !(*is_known && springs == accelerations.springs()) {
            accelerations.at(pulls, (&state.u, &state.v), state.time, a, counters)?;
        }
        // Damping at the end is that of the velocity expected there: with half a kick alone it were first order.
        v.copy_from_slice(&state.v);
        axpy(dt, a, v);
        axpy(half, a, &mut state.v);
        axpy(dt, &state.v, &mut state.u);
        accelerations.at(pulls, (&state.u, v), state.time + dt, a, counters)?;
        axpy(half, a, &mut state.v);
        // It depends on velocities where there is damping, and on their change where nodes are led.
        *is_known = pulls.system.damping.is_none() && !pulls.system.held.leads();
        Ok(())
    }
}
