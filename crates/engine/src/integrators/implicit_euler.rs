//! Implicit Euler: M (v⁺ − v)/dt = f(u + dt v⁺), every force at the end of the step; first order, unconditionally stable.

use super::follower::Loads;
use super::initial_guess::Start;
use super::momentum;
use crate::forces::acting::Acting;
use crate::forces::pulls::AnchorSpring;
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::Newton;
use crate::newton::incremental_potential::{IncrementalPotential, Motion};
use crate::number::Real;
use fem_scene::simulation::{Cause, Counters};

/// Implicit Euler as the minimisation of an energy, by [`Newton`]'s method.
pub struct ImplicitEuler<T: Real> {
    /// The method that it is solved by.
    pub newton: Newton<T>,
    loads: Loads<T>,
    inertial: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
    /// Change of velocity in the last step, m/s: the next one starts as if it went on so.
    last_change: Vec<[T; 3]>,
}

impl<T: Real> ImplicitEuler<T> {
    /// For a body.
    pub fn new(newton: Newton<T>, system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self { newton, loads: Loads::new(system, false), inertial: zero(), step: zero(), last_change: zero() }
    }

    /// What is known from earlier steps is of no use any more.
    pub fn forget(&mut self) {
        self.newton.forget();
        self.last_change.fill([T::default(); 3]);
    }

    /// One step. After an error the state is what it was. Says whether Newton's method has converged.
    pub fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        springs: &[AnchorSpring<T>],
        dt: f64,
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        let Self { newton, loads, inertial, step, last_change } = self;
        for (inertial, v) in inertial.iter_mut().zip(&state.v) {
            *inertial = v.map(|v| T::of(dt) * v);
        }
        let motion = Motion::new(system, inertial, dt);
        let acting = Acting { pulls: springs, load: None };
        let objective = IncrementalPotential { system, acting, start: &state.u, motion: Some(motion) };
        loads.gather(system, 1.0, &state.u, inertial);
        likely(step, inertial, last_change, T::of(dt));
        Start { newton, loads, objective, motion, end: state.time + dt }.find(step, counters)?;
        let converged = loads.minimize(newton, objective, 1.0, step, counters)?;
        momentum::restore(&loads.on(objective), dt, step);
        finish(step, dt, state, last_change);
        Ok(converged)
    }
}

/// Takes the step.
fn finish<T: Real>(step: &[[T; 3]], dt: f64, state: &mut State<T>, last_change: &mut [[T; 3]]) {
    let over_dt = T::of(1.0 / dt);
    for node in 0..step.len() {
        for i in 0..3 {
            let v = step[node][i] * over_dt;
            last_change[node][i] = v - state.v[node][i];
            state.v[node][i] = v;
            state.u[node][i] += step[node][i];
        }
    }
}

/// The step that is likely: velocities change as they did in the last one.
fn likely<T: Real>(step: &mut [[T; 3]], inertial: &[[T; 3]], last_change: &[[T; 3]], dt: T) {
    for ((step, inertial), change) in step.iter_mut().zip(inertial).zip(last_change) {
        *step = std::array::from_fn(|i| inertial[i] + dt * change[i]);
    }
}
