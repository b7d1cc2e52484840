//! The first step of a method that needs data of an earlier one.

use fem_model::simulation::{Cause, Counters};

use super::coefficients::Coefficients;
use super::{SecondOrder, bdf2};
use crate::forces::Moment;
use crate::integrators::Convergence;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::axpy;
use fem_solvers::Real;

impl<T: Real> SecondOrder<T> {
    /// Replaces the initial acceleration by the mean one over a step of implicit Euler, which is not taken. A part of dt M⁻¹ f would remain in
    /// the velocities of vibrations much faster than the step, with many times their energy.
    pub(super) fn smooth_acceleration(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let start = state.clone();
        self.of_implicit_euler(system, state, dt, counters)?;
        *state = start;
        std::mem::swap(&mut self.known.acceleration, &mut self.next.acceleration);
        self.acceleration.copy_from_slice(&self.known.acceleration);
        self.stage = None;
        Ok(())
    }

    /// A step of implicit Euler whose mean acceleration is that of the next step.
    fn of_implicit_euler(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let of = Coefficients { acceleration: [0.0, 1.0], ..bdf2::implicit_euler(dt) };
        let end = Moment::at(state.time + dt);
        self.advance(system, state, (dt, end), &of, counters)
    }

    /// The first step of an overdamped motion by a method that keeps an acceleration. M⁻¹ f is of the size λ v₀ where damping brings a
    /// velocity to rest at a rate λ of many times 1/dt; the method's formulas would add dt² λ v₀ to displacements, and springs would store energy
    /// that nobody has supplied. So the step is that of BDF2, and the acceleration at its end the mean one over half a step of implicit
    /// Euler, which is not taken. Both bring such velocities to rest.
    pub(super) fn settle(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let convergence = self.first_step(system, state, dt, counters)?;
        let end = state.clone();
        let (stage, of_step) = (self.stage, self.acceleration.clone());
        let (mean, half) = (self.next.mean.clone(), 0.5 * dt);
        state.time += dt;
        self.of_implicit_euler(system, state, half, counters)?;
        *state = end;
        (self.stage, self.acceleration, self.next.mean) = (stage, of_step, mean);
        self.has_evaluation = false;
        self.next.dt = Some(dt);
        // The step may be repeated.
        self.known.has_acceleration = false;
        Ok(convergence)
    }

    /// The first step of BDF2: two stages, of which the second takes the first as the step before it. With obstacles it is one of implicit Euler:
    /// the second stage would give a body that is hit in the first several times the impulse.
    pub(super) fn first_step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let (time, part) = (state.time, bdf2::FIRST_STAGE * dt);
        let end = Moment::at(time + dt);
        if system.forces.has_obstacles() {
            return self.advance(system, state, (dt, end), &bdf2::implicit_euler(dt), counters);
        }
        let first = self.advance(system, state, (part, end), &bdf2::first_stage(dt), counters)?;
        std::mem::swap(&mut self.known, &mut self.next);
        // The error is estimated from the mean acceleration of the whole step.
        std::mem::swap(&mut self.known.mean, &mut self.next.mean);
        self.known.age = self.next.age;
        state.time = time + part;
        let second = self.advance(system, state, (dt - part, end), &bdf2::second_stage(dt), counters);
        state.time = time;
        let Self { known, next, .. } = self;
        axpy(1.0, &known.increment, &mut next.increment);
        next.earlier_velocity.copy_from_slice(&known.earlier_velocity);
        next.dt = Some(dt);
        // The step may be repeated.
        known.dt = None;
        Ok(if second? == Convergence::Converged { first } else { Convergence::NotConverged })
    }
}
