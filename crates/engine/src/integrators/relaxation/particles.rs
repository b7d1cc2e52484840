//! Nodes as particles: inverse masses, displacements from inertia and loads alone, and velocities from displacements.

use crate::forces::{Moment, dead_load};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::triple;
use fem_solvers::Real;

/// Inverse masses of the nodes, and the start of the step.
pub struct Particles<T> {
    /// 1/kg, zero in constrained directions.
    pub inverse_masses: Vec<[T; 3]>,
    /// Displacements at the start of the step, m.
    pub start: Vec<[T; 3]>,
    /// Increment of the step, m.
    increment: Vec<[T; 3]>,
}

impl<T: Real> Particles<T> {
    /// Allocates for the nodes of a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let mut new = Self { inverse_masses: zero(), start: zero(), increment: zero() };
        new.set_masses(system);
        new
    }

    /// Takes the masses of the body, and the Dirichlet conditions that apply now.
    pub fn set_masses(&mut self, system: &System<T>) {
        self.increment.fill([T::one(); 3]);
        self.inverse_masses.fill([T::default(); 3]);
        system.mass.add_times(T::one(), &self.increment, &mut self.inverse_masses);
        for inverse in self.inverse_masses.as_flattened_mut() {
            *inverse = T::one() / *inverse;
        }
        system.dirichlet.clear_constrained(&mut self.inverse_masses);
    }

    /// Moves the nodes to the displacements of inertia and dead loads alone at the end of a step of `dt` seconds, constrained nodes to
    /// their prescribed displacements. Returns the square of the time that forces have to move them, s²: with damping α M it is dt²/(1
    /// + α dt).
    pub fn predict(&mut self, system: &System<T>, state: &mut State<T>, dt: f64) -> f64 {
        let end = Moment::at(state.time + dt);
        let damped = 1.0 / (1.0 + system.damping.map_or(0.0, |damping| damping.alpha * dt));
        let dt2 = dt * dt * damped;
        self.start.copy_from_slice(&state.u);
        self.increment.fill([T::default(); 3]);
        for (load, timer) in system.forces.active().filter(|(force, _)| force.name() == dead_load::NAME) {
            timer.time(|| load.add_gradient(&state.u, end, &mut self.increment));
        }
        let (of_velocity, of_load) = (T::of(dt * damped), T::of(dt2));
        let inertia = self.inverse_masses.iter().zip(&state.v);
        for (w, (inverse_mass, v)) in self.increment.iter_mut().zip(inertia) {
            *w = triple(|i| of_velocity * v[i] - of_load * inverse_mass[i] * w[i]);
        }
        system.prescribe(&self.start, end, &mut self.increment);
        for (u, w) in state.u.iter_mut().zip(&self.increment) {
            *u = triple(|i| u[i] + w[i]);
        }
        dt2
    }

    /// Computes the velocities of a step from its displacements: Müller et al. 2007, algorithm 1, line 13.
    pub fn finish(&self, state: &mut State<T>, dt: f64) {
        let over_dt = T::of(1.0 / dt);
        for (v, (u, start)) in state.v.iter_mut().zip(state.u.iter().zip(&self.start)) {
            *v = triple(|i| (u[i] - start[i]) * over_dt);
        }
    }

    /// Largest displacement from the start of the step, m.
    pub fn largest_increment(&self, u: &[[T; 3]]) -> f64 {
        largest_difference(u, &self.start)
    }
}

/// Largest difference of an entry.
pub fn largest_difference<T: Real>(a: &[[T; 3]], b: &[[T; 3]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(&a, &b)| (a - b).as_f64().abs()).fold(0.0, f64::max)
}
