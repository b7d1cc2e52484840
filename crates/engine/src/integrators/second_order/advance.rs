//! A step from its coefficients: the equation of its stage, its solution, and its end.

use fem_model::simulation::{Cause, Counters};

use super::SecondOrder;
use super::coefficients::Coefficients;
use crate::forces::Moment;
use crate::integrators::initial_guess::InitialGuess;
use crate::integrators::{Convergence, momentum};
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::incremental_potential::{Increment, Inertia, StepEnd};
use fem_elements::vector::{axpy, max_norm, triple};
use fem_solvers::Real;

/// Part of the change before it that a change of the displacements of damping must stay below.
const SLOW: f64 = 0.5;

/// Part of the body's length that an acceleration may add to an extrapolated increment.
const LONG: f64 = 0.2;

impl<T: Real> SecondOrder<T> {
    /// Moves the state by `dt` seconds. Obstacles are those at the moment `end`.
    pub(super) fn advance(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        (dt, end): (f64, Moment),
        of: &Coefficients,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        self.predict(system, state, dt, of);
        extrapolate(&mut self.step, &self.inertial, &self.acceleration, of.tau * of.tau, system.length);
        let (mut left, tolerance) = (f64::INFINITY, self.newton.limits().tolerance * system.length);
        let convergence = loop {
            let convergence = self.minimize(system, state, (dt, end), of, counters)?;
            let before = left;
            left = self.review_damping(system, state);
            if left <= tolerance || left > SLOW * before || convergence == Convergence::NotConverged {
                break convergence;
            }
        };
        self.finish(system, state, dt, of)?;
        Ok(convergence)
    }

    /// Solves the step's equation with the damping matrix at `stiffness_at`.
    fn minimize(
        &mut self,
        system: &System<T>,
        state: &State<T>,
        (dt, end): (f64, Moment),
        of: &Coefficients,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { newton, followers, inertial, still, stiffness_at, step, .. } = self;
        let stage = Moment::at(state.time + of.stage * dt);
        let is_damped = system.is_damped();
        let inertia = Inertia {
            still: is_damped.then_some(&still[..]),
            stiffness_at: is_damped.then_some(&stiffness_at[..]),
            step_end: Some(StepEnd { moment: end, ratio: 1.0 / of.stage, weight: of.obstacles })
                .filter(|_| stage != end || of.obstacles != 1.0),
            ..Inertia::of_stage(system, inertial, of.tau, of.stage_velocity())
        };
        let increment = Increment { start: &state.u, end: stage, inertia: Some(inertia) };
        followers.evaluate(system, &increment, step);
        let convergence = InitialGuess { newton, followers, system, increment, inertia }.minimize(step, counters)?;
        momentum::restore(&followers.potential(system, increment), of.tau, of.stage_velocity(), step);
        Ok(convergence)
    }

    /// Moves the displacements at which viscosity takes its matrix to those of the stage that was found, and returns the largest
    /// change, m; zero for other damping. Forces of viscosity have no torque about these displacements, and do no work on a rotation of them.
    fn review_damping(&mut self, system: &System<T>, state: &State<T>) -> f64 {
        if !system.has_viscosity() {
            return 0.0;
        }
        let Self { stiffness_at, step, .. } = self;
        let mut largest = 0.0;
        for (at, (u, step)) in stiffness_at.iter_mut().zip(state.u.iter().zip(&*step)) {
            let now: [T; 3] = triple(|i| u[i] + step[i]);
            largest = (0..3).map(|i| (now[i] - at[i]).as_f64().abs()).fold(largest, f64::max);
            *at = now;
        }
        largest
    }

    /// Writes the data of the step's equation from the start: ẑ, ž, and the displacements at which damping takes its stiffness.
    fn predict(&mut self, system: &System<T>, state: &State<T>, dt: f64, of: &Coefficients) {
        let Self { start, known, inertial, still, stiffness_at, velocity, step, .. } = self;
        let is_moving = system.dirichlet.has_motion();
        known.combine(&of.inertial, &state.v, inertial);
        known.combine(&of.velocity, &state.v, velocity);
        if is_moving {
            start.prescribe(system, state, dt, of.stage);
            prescribe(system, state, dt, of, step);
            let square = T::of(of.tau * of.tau);
            set_constrained(system, step, &start.acceleration, square, inertial);
        } else {
            system.dirichlet.clear_constrained(inertial);
        }
        if !system.is_damped() {
            return;
        }
        known.combine(&of.known_stage_velocity(), &state.v, still);
        let over = T::of(of.tau / of.stage_velocity());
        for (still, inertial) in still.iter_mut().zip(&*inertial) {
            *still = triple(|i| inertial[i] - over * still[i]);
        }
        if is_moving {
            set_constrained(system, step, &start.velocity, over, still);
        } else {
            system.dirichlet.clear_constrained(still);
        }
        system.extrapolate((&state.u, &state.v), of.stage * dt, stiffness_at);
    }

    /// Moves the state to the end of the step, and keeps the data for the next step.
    fn finish(&mut self, system: &System<T>, state: &mut State<T>, dt: f64, of: &Coefficients) -> Result<(), Cause> {
        let Self { start, known, next, inertial, step, velocity, acceleration, .. } = self;
        let over_square = T::of(1.0 / (of.tau * of.tau));
        for (a, (step, inertial)) in acceleration.iter_mut().zip(step.iter().zip(&*inertial)) {
            *a = triple(|i| (step[i] - inertial[i]) * over_square);
        }
        if !next.increment.is_empty() {
            next.increment.copy_from_slice(step);
            next.earlier_velocity.copy_from_slice(&state.v);
        }
        axpy(1.0 / of.stage, step, &mut state.u);
        state.v.copy_from_slice(velocity);
        axpy(of.of_velocity, acceleration, &mut state.v);
        self.stage = Some(of.stage);
        next.dt = Some(dt);
        next.has_acceleration = !next.acceleration.is_empty();
        if next.has_acceleration {
            next.acceleration.copy_from_slice(acceleration);
        }
        let has_memory = next.has_acceleration || !next.increment.is_empty();
        let end = Moment::at(state.time + dt);
        if let Some(by_obstacles) = if has_memory { start.by_obstacles(system, &state.u, end)? } else { None } {
            if of.beyond > 0.0 {
                axpy(-of.beyond, by_obstacles, &mut state.v);
            }
            // Vectors that are not kept have no nodes.
            axpy(-of.obstacles, by_obstacles, &mut next.acceleration);
            axpy(dt, by_obstacles, &mut next.earlier_velocity);
        }
        if next.has_acceleration {
            let [of_known, of_stage] = of.acceleration;
            for (next, known) in next.acceleration.iter_mut().zip(&known.acceleration) {
                *next = triple(|i| T::of(of_known) * known[i] + T::of(of_stage) * next[i]);
            }
        }
        if system.dirichlet.has_motion() {
            start.prescribe(system, state, dt, 1.0);
            system.dirichlet.copy_constrained(&start.velocity, &mut state.v);
        } else {
            system.dirichlet.clear_constrained(&mut state.v);
        }
        Ok(())
    }
}

/// The increment with this acceleration; zero if it would be long, because vibrations much faster than the step change their accelerations
/// within the step.
fn extrapolate<T: Real>(step: &mut [[T; 3]], inertial: &[[T; 3]], acceleration: &[[T; 3]], square: f64, length: f64) {
    step.copy_from_slice(inertial);
    axpy(square, acceleration, step);
    // NaN fails the comparison.
    if !(square * max_norm(acceleration) <= LONG * length) {
        step.fill([T::default(); 3]);
    }
}

/// Overwrites the constrained entries of a stage's increment.
fn prescribe<T: Real>(system: &System<T>, state: &State<T>, dt: f64, of: &Coefficients, step: &mut [[T; 3]]) {
    system.prescribe(&state.u, Moment::at(state.time + dt), step);
    if of.stage != 1.0 {
        system.dirichlet.scale_constrained(of.stage, step);
    }
}

/// x = z − factor y at the constrained degrees of freedom.
fn set_constrained<T: Real>(system: &System<T>, z: &[[T; 3]], y: &[[T; 3]], factor: T, x: &mut [[T; 3]]) {
    system.dirichlet.copy_constrained(z, x);
    // Free entries of y are zero.
    axpy(-factor.as_f64(), y, x);
}
