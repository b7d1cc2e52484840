//! Implicit methods of second order. Each is a set of coefficients; a step is one minimization of the incremental potential.
//!
//! Prescribed motions enter with their exact velocities and accelerations. Damping takes its stiffness at displacements
//! extrapolated with the velocity at the start: with those at the start a step would be of first order. Forces of obstacles act at the
//! end of a step, whatever the stage.

mod advance;
mod bdf2;
mod coefficients;
mod error;
mod generalized_alpha;
mod history;
mod implicit_midpoint;
mod newmark;
mod scheme;
mod start;

use fem_scene::simulation::{Cause, Counters, History};

use super::followers::Followers;
use super::{Convergence, Integrator, LastStage};
use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::Newton;
use crate::solvers::Solver;
use coefficients::Coefficients;
use fem_elements::Real;
use fem_elements::history::{put, put_option, take, take_option};
use fem_elements::vector::axpy;
use history::Known;
pub use scheme::Scheme;
use start::Start;

/// An implicit method of second order with its solver and vectors.
pub struct SecondOrder<T: Real> {
    scheme: Scheme,
    newton: Newton<T>,
    followers: Followers<T>,
    start: Start<T>,
    /// State of earlier steps that this step needs, and the state for the next step.
    known: Known<T>,
    next: Known<T>,
    inertial: Vec<[T; 3]>,
    still: Vec<[T; 3]>,
    stiffness_at: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
    /// Velocity at the end as far as it is known at the start, m/s.
    velocity: Vec<[T; 3]>,
    /// Acceleration of the last step's stage, m/s²; the initial guess of the next step assumes the same.
    acceleration: Vec<[T; 3]>,
    /// θ of the last step.
    stage: Option<f64>,
    /// True if each step estimates its error.
    estimates: bool,
    /// Error estimate of the last step, m.
    error: Option<f64>,
    /// Velocities at the start of a step that estimates its error, m/s.
    before: Vec<[T; 3]>,
}

impl<T: Real> SecondOrder<T> {
    /// Allocates its vectors for a body. `estimates` tells whether each step estimates its error.
    pub fn new(scheme: Scheme, newton: Newton<T>, system: &System<T>, estimates: bool) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let has_step = scheme == Scheme::Bdf2 || scheme.has_acceleration() && system.is_damped();
        let known = Known::new(system.nodes(), [scheme.has_acceleration(), has_step, estimates]);
        Self {
            scheme,
            newton,
            followers: Followers::new(system),
            start: Start::new(system),
            next: known.clone(),
            known,
            inertial: zero(),
            still: zero(),
            stiffness_at: zero(),
            step: zero(),
            velocity: zero(),
            acceleration: zero(),
            stage: None,
            estimates,
            error: None,
            before: vec![[T::default(); 3]; if estimates { system.nodes() } else { 0 }],
        }
    }

    /// Brings the history up to date with the state at the start of a step.
    fn begin(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        if system.dirichlet.has_motion() && self.start.jump(system, state, dt)? {
            self.known.forget();
        }
        let Self { scheme, start, known, acceleration, estimates, .. } = self;
        if scheme.has_acceleration() && !known.has_acceleration {
            let a = &mut known.acceleration;
            start.accelerations(system, state, dt, a, counters)?;
            known.has_acceleration =
                !(start.is_overdamped(system, state, dt, &state.v)? || start.is_overdamped(system, state, dt, a)?);
            acceleration.copy_from_slice(a);
        }
        if *estimates && known.age.is_none() {
            if known.has_acceleration {
                known.mean.copy_from_slice(&known.acceleration);
            } else {
                start.accelerations(system, state, dt, &mut known.mean, counters)?;
            }
            known.age = Some(0.0);
        }
        Ok(())
    }

    /// The first step of an overdamped motion by a method that keeps an acceleration. M⁻¹ f is of the size λ v₀ where damping brings a
    /// velocity to rest at a rate λ of many times 1/dt; the method's formulas would add dt² λ v₀ to displacements, and springs would store energy
    /// that nobody has supplied. So the step is that of BDF2, and the acceleration at its end the mean one over half a step of implicit
    /// Euler, which is not taken. Both bring such velocities to rest.
    fn settle(
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
        let of = Coefficients { acceleration: [0.0, 1.0], ..bdf2::implicit_euler(half) };
        let moment = Moment::at(state.time + half);
        self.advance(system, state, (half, moment), &of, counters)?;
        *state = end;
        (self.stage, self.acceleration, self.next.mean) = (stage, of_step, mean);
        self.next.dt = Some(dt);
        // The step may be repeated.
        self.known.has_acceleration = false;
        Ok(convergence)
    }

    /// The first step of BDF2: two stages, of which the second takes the first as the step before it.
    fn first_step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let (time, part) = (state.time, bdf2::FIRST_STAGE * dt);
        let end = Moment::at(time + dt);
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

impl<T: Real> Integrator<T> for SecondOrder<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        self.begin(system, state, dt, counters)?;
        let (before, end) = (self.known.dt, Moment::at(state.time + dt));
        self.error = None;
        if self.estimates {
            self.before.copy_from_slice(&state.v);
        }
        let convergence = match self.scheme.coefficients(dt, before) {
            Some(_) if self.scheme.has_acceleration() && !self.known.has_acceleration => {
                self.settle(system, state, dt, counters)?
            }
            Some(of) => self.advance(system, state, (dt, end), &of, counters)?,
            None => self.first_step(system, state, dt, counters)?,
        };
        if self.estimates {
            self.keep_mean(system, state, dt)?;
            self.estimate(system, dt, before.map(|before| dt / before));
        }
        Ok(convergence)
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.known, &mut self.next);
    }

    fn forget(&mut self) {
        self.newton.forget();
        self.known.forget();
        self.acceleration.fill([T::default(); 3]);
        self.stage = None;
    }

    fn forget_forces(&mut self) {
        // Forces jump, and with them the acceleration; the difference quotients of a multistep method must not reach across that.
        self.known.forget();
    }

    fn save(&self, history: &mut History) {
        self.known.save(history);
        put(history, "second_order.last_change", self.acceleration.as_flattened());
        put_option(history, "second_order.stage", self.stage);
        self.newton.save(history);
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        self.known.restore(history)?;
        take(history, "second_order.last_change", self.acceleration.as_flattened_mut())?;
        self.stage = take_option(history, "second_order.stage")?;
        self.newton.restore(history)
    }

    fn solver(&self) -> Option<&Solver<T>> {
        Some(self.newton.solver())
    }

    fn last_stage(&self) -> Option<LastStage<'_, T>> {
        Some(LastStage { part: self.stage?, acceleration: &self.acceleration })
    }

    fn estimated_error(&self) -> Option<f64> {
        self.error
    }

    /// The numerical damping of these methods bounds the energy. The other two keep or multiply the energy of motions with large
    /// deformations.
    fn is_unconditionally_stable(&self) -> bool {
        matches!(self.scheme, Scheme::GeneralizedAlpha(_) | Scheme::Bdf2)
    }

    fn has_line_search(&self) -> bool {
        true
    }
}
