//! Implicit Euler: M (v⁺ − v)/dt = f(u + dt v⁺), every force at the end of the step; first order, unconditionally stable.

use fem_model::simulation::{Cause, Counters, History};

use super::followers::Followers;
use super::initial_guess::InitialGuess;
use super::last_change::{extrapolate, finish};
use super::{Convergence, Integrator, Memory, momentum};
use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::incremental_potential::{Increment, Inertia};
use crate::newton::{LastEvaluation, Newton};
use fem_elements::history::{put, take};
use fem_solvers::{Real, Solver};

/// Implicit Euler as the minimum of the incremental potential, found by [`Newton`]'s method.
pub struct ImplicitEuler<T: Real> {
    newton: Newton<T>,
    followers: Followers<T>,
    inertial: Vec<[T; 3]>,
    /// Displacements at which viscosity takes its matrix, m; empty without.
    stiffness_at: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
    /// Change of velocity in the last step, m/s; the initial guess of the next step assumes the same.
    last_change: Vec<[T; 3]>,
}

impl<T: Real> ImplicitEuler<T> {
    /// Allocates its vectors for a body.
    pub fn new(newton: Newton<T>, system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let (followers, stiffness_at) = (Followers::new(system), Vec::new());
        Self { newton, followers, inertial: zero(), stiffness_at, step: zero(), last_change: zero() }
    }
}

impl<T: Real> Memory for ImplicitEuler<T> {
    fn accept(&mut self) {}

    fn forget(&mut self) {
        self.newton.forget();
        self.last_change.fill([T::default(); 3]);
    }

    fn forget_forces(&mut self) {}

    fn save(&self, history: &mut History) {
        put(history, "implicit_euler.last_change", self.last_change.as_flattened());
        self.newton.save(history);
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        take(history, "implicit_euler.last_change", self.last_change.as_flattened_mut())?;
        self.newton.restore(history)
    }
}

impl<T: Real> Integrator<T> for ImplicitEuler<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { newton, followers, inertial, stiffness_at, step, last_change } = self;
        for (inertial, v) in inertial.iter_mut().zip(&state.v) {
            *inertial = v.map(|v| T::of(dt) * v);
        }
        let mut inertia = Inertia::new(system, inertial, dt);
        if system.has_viscosity() {
            stiffness_at.resize(state.u.len(), [T::default(); 3]);
            system.extrapolate_half((&state.u, &state.v), dt, stiffness_at);
            inertia.stiffness_at = Some(stiffness_at);
        }
        let increment = Increment { start: &state.u, end: Moment::at(state.time + dt), inertia: Some(inertia) };
        followers.evaluate(system, &increment, inertial);
        extrapolate(step, inertial, last_change, dt);
        let convergence = InitialGuess { newton, followers, system, increment, inertia }.minimize(step, counters)?;
        momentum::restore(&followers.potential(system, increment), dt, 1.0, step);
        finish(step, dt, state, last_change);
        Ok(convergence)
    }

    fn solver(&self) -> Option<&Solver<T>> {
        Some(self.newton.solver())
    }

    fn last_evaluation(&self) -> Option<&LastEvaluation<T>> {
        Some(self.newton.last_evaluation())
    }
}
