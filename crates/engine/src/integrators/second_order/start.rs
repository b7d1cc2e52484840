//! The start of a run, or of a step at which velocities jump: impulses, and accelerations from the equation of motion.

use fem_model::simulation::{Cause, Counters};

use super::super::mass_inverse::MassInverse;
use crate::forces::Moment;
use crate::model::mass::Mass;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::{dot, max_norm, triple};
use fem_solvers::Real;

/// Part of the largest prescribed velocity from which a change of it is a jump.
const JUMP: f64 = 1e-9;

/// Part of a step by which a time is moved into it, to tell the sides of a kink.
const INSIDE: f64 = 1e-6;

/// Solves with the mass at the start of steps, with the vectors for that and for prescribed motions.
pub struct Start<T: Real> {
    mass: MassInverse<T>,
    force: Vec<[T; 3]>,
    obstacles: Vec<[T; 3]>,
    /// Velocities (m/s) and accelerations (m/s²) of prescribed motions, zero at free degrees of freedom.
    pub velocity: Vec<[T; 3]>,
    /// See `velocity`.
    pub acceleration: Vec<[T; 3]>,
    /// Work of the impulses of the last jump of prescribed velocities, J.
    pub work: f64,
}

impl<T: Real> Start<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self {
            mass: MassInverse::new(&system.mass),
            force: zero(),
            obstacles: zero(),
            velocity: zero(),
            acceleration: zero(),
            work: 0.0,
        }
    }

    /// Writes the rates of the prescribed motions at a part of a step of `dt` seconds, one-sided at its ends.
    pub fn prescribe(&mut self, system: &System<T>, state: &State<T>, dt: f64, part: f64) {
        let inside = part.clamp(INSIDE, 1.0 - INSIDE);
        let times = (state.time + part * dt, state.time + inside * dt);
        let Self { velocity, acceleration, .. } = self;
        system.profile.prescribed.time(|| system.dirichlet.write_rates(&system.rest, times, velocity, acceleration));
    }

    /// Gives constrained degrees of freedom the velocity with which their motion goes on, and free ones the impulse of that change
    /// through a consistent mass, M_ff Δv_f = −M_fp Δv_p. Returns whether velocities have jumped.
    pub fn jump(&mut self, system: &System<T>, state: &mut State<T>, dt: f64) -> Result<bool, Cause> {
        self.prescribe(system, state, dt, 0.0);
        let Self { mass, force, velocity, obstacles: change, work, .. } = self;
        let largest = max_norm(velocity);
        for ((change, velocity), v) in change.iter_mut().zip(&*velocity).zip(&state.v) {
            *change = triple(|i| velocity[i] - v[i]);
        }
        system.dirichlet.clear_free(change);
        let size = max_norm(change);
        let round_off = JUMP.max(16.0 * T::EPSILON.as_f64());
        if size <= round_off * largest.max(size) * f64::from(u8::from(largest > 0.0)) || size == 0.0 {
            return Ok(false);
        }
        let before = system.mass.kinetic_energy(&state.v);
        system.dirichlet.copy_constrained(velocity, &mut state.v);
        if matches!(system.mass, Mass::Consistent(_)) {
            force.fill([T::default(); 3]);
            system.add_mass_times(T::of(-1.0), change, force);
            mass.solve(system, force, change)?;
            system.dirichlet.clear_constrained(change);
            for (v, change) in state.v.iter_mut().zip(&*change) {
                *v = triple(|i| v[i] + change[i]);
            }
        }
        *work = system.mass.kinetic_energy(&state.v) - before;
        Ok(true)
    }

    /// Accelerations of the free degrees of freedom at the start of a step, m/s²: M a = f, without the forces of obstacles.
    pub fn accelerations(
        &mut self,
        system: &System<T>,
        state: &State<T>,
        dt: f64,
        a: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let moment = Moment::at(state.time);
        counters.force_assemblies += 1;
        system.force(&state.u, &state.v, &state.u, moment, &mut self.force);
        if system.forces.has_obstacles() {
            system.obstacle_energy_and_gradient(&state.u, moment, &mut self.obstacles);
            add(&self.obstacles, &mut self.force);
        }
        if system.dirichlet.has_motion() {
            self.prescribe(system, state, dt, 0.0);
            system.add_mass_times(T::of(-1.0), &self.acceleration, &mut self.force);
        }
        self.mass.solve(system, &mut self.force, a)
    }

    /// Returns true if damping changes these rates by more than their own size in a step: M⁻¹ C w dt is larger than w.
    pub fn is_overdamped(
        &mut self,
        system: &System<T>,
        state: &State<T>,
        dt: f64,
        rates: &[[T; 3]],
    ) -> Result<bool, Cause> {
        if !system.is_damped() {
            return Ok(false);
        }
        let Self { mass, force, obstacles: change, .. } = self;
        force.fill([T::default(); 3]);
        system.add_damping_force(&state.u, rates, force);
        mass.solve(system, force, change)?;
        Ok(dt * max_norm(change) > max_norm(rates))
    }

    /// Returns true if this acceleration is one of vibrations that the step does not resolve, ω dt > 1, and what `overshoot` leaves of it in
    /// the velocities would have more than a hundredth of their energy: e² ω² dt² in units of that, with the Rayleigh quotient ω² = aᵀ K a / aᵀ M a.
    pub fn is_unresolved(
        &mut self,
        system: &System<T>,
        state: &State<T>,
        dt: f64,
        (a, overshoot): (&[[T; 3]], f64),
    ) -> bool {
        if overshoot == 0.0 {
            return false;
        }
        self.force.fill([T::default(); 3]);
        system.add_stiffness_times(T::one(), &state.u, a, &mut self.force);
        let square = dt * dt * dot(a, &self.force) / system.mass.product(a, a);
        square > 1.0 && overshoot * square > 0.01
    }

    /// Accelerations by the obstacles alone at displacements and a moment, m/s²; `None` if they do not touch the body.
    pub fn by_obstacles(
        &mut self,
        system: &System<T>,
        u: &[[T; 3]],
        moment: Moment,
    ) -> Result<Option<&[[T; 3]]>, Cause> {
        if !system.forces.has_obstacles() {
            return Ok(None);
        }
        let Self { mass, force, obstacles, .. } = self;
        system.obstacle_energy_and_gradient(u, moment, force);
        if max_norm(force) == 0.0 {
            return Ok(None);
        }
        for force in force.as_flattened_mut() {
            *force = -*force;
        }
        mass.solve(system, force, obstacles)?;
        Ok(Some(obstacles))
    }
}

fn add<T: Real>(x: &[[T; 3]], sum: &mut [[T; 3]]) {
    for (sum, x) in sum.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
        *sum += *x;
    }
}
