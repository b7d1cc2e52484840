//! Velocity Verlet, Swope et al. (1982): half a kick, a drift, half a kick. Second order; stable for ω dt < 2 of the fastest
//! vibration; symplectic without damping.

use fem_model::simulation::{Cause, Counters, History};

use super::{Accelerations, Convergence, Integrator, Memory, Stage, StageWork};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::history::{put, take};
use fem_elements::vector::axpy;
use fem_solvers::Real;

/// Velocity Verlet with its vectors.
pub struct Verlet<T: Real> {
    accelerations: Accelerations<T>,
    a: Vec<[T; 3]>,
    v: Vec<[T; 3]>,
    /// True if `a` is still the acceleration at the start of the next step.
    is_known: bool,
}

impl<T: Real> Verlet<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let accelerations = Accelerations::new(system);
        Self { accelerations, a: zero(), v: zero(), is_known: false }
    }
}

impl<T: Real> Memory for Verlet<T> {
    fn accept(&mut self) {}

    fn forget(&mut self) {
        self.is_known = false;
    }

    fn forget_forces(&mut self) {
        self.is_known = false;
    }

    fn save(&self, history: &mut History) {
        let a: &[[T; 3]] = if self.is_known { &self.a } else { &[] };
        put(history, "verlet.acceleration", a.as_flattened());
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        self.is_known = !history.get("verlet.acceleration")?.is_empty();
        if self.is_known { take(history, "verlet.acceleration", self.a.as_flattened_mut()) } else { Ok(()) }
    }
}

impl<T: Real> Integrator<T> for Verlet<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { accelerations, a, v, is_known } = self;
        let half = 0.5 * dt;
        let has_jump = accelerations.begin(system, state, dt, a)?;
        if has_jump || !*is_known {
            let start = Stage { after: 0.0, weight: 0.0 };
            accelerations.at(system, (&mut state.u, &mut state.v), start, a, counters)?;
        }
        // Damping at the end takes the velocity predicted there: with that after half a kick the method would be of first order. The
        // corrected velocity differs from it by O(dt²), so this acceleration also serves at the start of the next step.
        v.copy_from_slice(&state.v);
        axpy(dt, a, v);
        axpy(half, a, &mut state.v);
        axpy(dt, &state.v, &mut state.u);
        accelerations.at(system, (&mut state.u, v), Stage { after: 1.0, weight: 1.0 }, a, counters)?;
        axpy(half, a, &mut state.v);
        accelerations.dissipate(&state.v, 1.0);
        *is_known = true;
        accelerations.end(system, state);
        Ok(Convergence::Converged)
    }

    fn work_of_stages(&self) -> Option<StageWork> {
        Some(self.accelerations.work())
    }

    /// ½ v₋ᵀ M v₊ of the velocities half a step before and after, v ∓ ½ dt a.
    fn kinetic_energy(&self, system: &System<T>, state: &State<T>, dt: f64) -> f64 {
        system.mass.kinetic_energy(&state.v) - (0.5 * dt).powi(2) * system.mass.kinetic_energy(&self.a)
    }
}
