//! Compares the energy of a body with the energy supplied by loads, prescribed motions and the initial state.
//!
//! If the kinetic energy exceeds that, the motion grows without bound: an explicit method beyond its critical time step, or a linearized
//! one on a body that is too stiff for it. If kinetic and elastic energy exceed it after a number of iterations that the scene has set,
//! the iteration ended far from the solution of the step: a small number of sweeps over a stiff body leaves strains that its loads cannot
//! cause.

use fem_scene::simulation::{Cause, History};

use crate::forces::{Moment, Potential};
use crate::integrators::Integrator;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::Real;
use fem_elements::history::{put_option, take, take_option};
use fem_elements::vector::{dot, triple};

/// Energy over supplied energy beyond which a motion has diverged, or a step has not converged. The margin is for the work of loads, which is summed by
/// a rule of first order.
const LIMIT: f64 = 10.0;

/// The energy supplied to a body.
#[derive(Default)]
pub(super) struct SuppliedEnergy<T> {
    /// Kinetic and elastic energy at the start, and the potential of the steady loads then; `None` before the first step.
    start: Option<(f64, f64)>,
    /// Work since the start of the loads and constraints whose work depends on the path, J.
    work: f64,
    /// Largest energy so far, J.
    largest: f64,
    /// Forces on the nodes, N, and changes of their displacements, m.
    force: Vec<[T; 3]>,
    change: Vec<[T; 3]>,
    /// Divergence is not an error, for studies of the growth of a motion.
    pub(super) may_diverge: bool,
}

impl<T: Real> SuppliedEnergy<T> {
    /// Starts again: the state is a new one.
    pub(super) fn forget(&mut self) {
        (self.start, self.work, self.largest) = (None, 0.0, 0.0);
    }

    /// Adds work that was done in a step beside that of loads and prescribed motions, J: moving obstacles push the body.
    pub(super) fn add(&mut self, work: f64) {
        self.work += work;
    }

    /// Returns the sums, to be restored after a rejected step.
    pub(super) fn sums(&self) -> [f64; 2] {
        [self.work, self.largest]
    }

    /// Returns to earlier sums.
    pub(super) fn set_sums(&mut self, sums: [f64; 2]) {
        [self.work, self.largest] = sums;
    }

    /// Adds its sums to a history.
    pub(super) fn save(&self, history: &mut History) {
        let (energy, potential) = self.start.unzip();
        put_option(history, "supplied.energy", energy);
        put_option(history, "supplied.potential", potential);
        history.put("supplied.sums", [self.work, self.largest]);
    }

    /// Restores the sums that [`save`](Self::save) has added.
    pub(super) fn restore(&mut self, history: &History) -> Result<(), String> {
        let (energy, potential) =
            (take_option(history, "supplied.energy")?, take_option(history, "supplied.potential")?);
        self.start = energy.zip(potential);
        let mut sums = [0.0; 2];
        take(history, "supplied.sums", &mut sums)?;
        [self.work, self.largest] = sums;
        Ok(())
    }

    /// Adds what the step from `before` to `state` has supplied, and refuses a state with far more kinetic energy. The bound of the
    /// largest speed comes first: most steps need no energy at all.
    pub(super) fn check(
        &mut self,
        system: &System<T>,
        integrator: &dyn Integrator<T>,
        before: &State<T>,
        state: &State<T>,
        dt: f64,
    ) -> Result<(), Cause> {
        let moment = Moment::at(before.time + dt);
        self.add_work(system, integrator, before, state, dt);
        let speed = f64::max(before.largest_squared_speed(), state.largest_squared_speed());
        if 0.5 * system.total_mass * speed <= LIMIT * self.largest {
            return Ok(());
        }
        self.raise_largest(system, state, dt, moment);
        let kinetic = if integrator.has_staggered_velocities() {
            // Its own kinetic energy exceeds the true one a hundred times just below the critical time step.
            add_scaled(&before.v, 1.0, &state.v, &mut self.change);
            0.25 * system.mass.kinetic_energy(&self.change)
        } else {
            system.mass.kinetic_energy(&state.v)
        };
        if kinetic <= LIMIT * self.largest + round_off(system) {
            return Ok(());
        }
        Err(Cause::Diverged { kinetic, supplied: self.largest })
    }

    /// Adds what the step from `before` to `state` has supplied, and returns whether the body has far more energy than that.
    pub(super) fn is_exceeded(
        &mut self,
        system: &System<T>,
        integrator: &dyn Integrator<T>,
        before: &State<T>,
        state: &State<T>,
        dt: f64,
    ) -> bool {
        let moment = Moment::at(before.time + dt);
        self.add_work(system, integrator, before, state, dt);
        self.raise_largest(system, state, dt, moment);
        // NaN counts as too much energy.
        let is_supplied = energy(system, state, moment) <= LIMIT * self.largest + round_off(system);
        !is_supplied
    }

    /// Takes the energies of the state before the first step.
    pub(super) fn start_at(&mut self, system: &System<T>, start: &State<T>, dt: f64) {
        let moment = Moment::at(start.time + dt);
        let supplied = energy(system, start, moment);
        self.start = Some((supplied, steady_potential(system, &start.u, moment)));
        self.largest = self.largest.max(supplied);
    }

    /// Adds the work of a step that is not known from the displacements alone.
    fn add_work(
        &mut self,
        system: &System<T>,
        integrator: &dyn Integrator<T>,
        before: &State<T>,
        state: &State<T>,
        dt: f64,
    ) {
        if self.start.is_none() {
            self.start_at(system, before, dt);
        }
        self.work += self.work_of_loads(system, integrator, before, state, dt);
        if system.dirichlet.has_motion() {
            self.work += self.work_of_motions(system, integrator, before, state, dt);
        }
    }

    /// Takes the energy supplied so far into the largest.
    fn raise_largest(&mut self, system: &System<T>, state: &State<T>, dt: f64, moment: Moment) {
        let (start, potential) = self.start.expect("the energies at the start were taken");
        self.make_room(system.nodes());
        // In the first step of explicit Euler velocities change and displacements do not, so the next displacements are used.
        add_scaled(&state.u, dt, &state.v, &mut self.change);
        let work = |u: &[[T; 3]]| potential - steady_potential(system, u, moment);
        // Who moves nodes supplies at least their kinetic energy; the work of an explicit step takes the forces and velocities at its start.
        let of_motions = if system.dirichlet.has_motion() { kinetic_of_motions(system, &state.v) } else { 0.0 };
        let steady = f64::max(work(&state.u), work(&self.change));
        self.largest = self.largest.max(start + self.work + steady).max(of_motions);
    }

    /// Work in a step of follower loads, of loads that change with the time and of moving obstacles, J. Their forces are those at the end
    /// of an implicit step; else they take the displacements at the start of the step and the time of its end, and the velocities are
    /// those at its end.
    fn work_of_loads(
        &mut self,
        system: &System<T>,
        integrator: &dyn Integrator<T>,
        before: &State<T>,
        state: &State<T>,
        dt: f64,
    ) -> f64 {
        if !system.forces.active().any(|(potential, _)| !is_steady(potential)) {
            return 0.0;
        }
        self.make_room(system.nodes());
        self.force.fill([T::default(); 3]);
        let is_implicit = integrator.has_line_search();
        let u = if is_implicit { &state.u } else { &before.u };
        for (potential, _) in system.forces.active().filter(|(potential, _)| !is_steady(*potential)) {
            potential.add_gradient(u, Moment::at(before.time + dt), &mut self.force);
        }
        if is_implicit {
            add_scaled(&state.u, -1.0, &before.u, &mut self.change);
            return -dot(&self.force, &self.change);
        }
        -dt * dot(&self.force, &state.v)
    }

    /// Work of the reactions in a step, J. Forces are those of the end of an implicit step, and of the start of an explicit one.
    fn work_of_motions(
        &mut self,
        system: &System<T>,
        integrator: &dyn Integrator<T>,
        before: &State<T>,
        state: &State<T>,
        dt: f64,
    ) -> f64 {
        if let Some(work) = integrator.work_of_motions() {
            return work;
        }
        self.make_room(system.nodes());
        let Self { force, change, .. } = self;
        if integrator.is_unconditionally_stable() {
            let damping_at = system.damping_displacements(before, dt);
            system.force(&state.u, &state.v, &damping_at, Moment::at(before.time + dt), force);
        } else {
            system.force(&before.u, &before.v, &before.u, integrator.moment(before), force);
        }
        add_scaled(&state.v, -1.0, &before.v, change);
        system.add_mass_times(T::of(-1.0 / dt), change, force);
        add_scaled(&state.u, -1.0, &before.u, change);
        system.dirichlet.clear_free(change);
        -dot(force, change)
    }

    fn make_room(&mut self, nodes: usize) {
        self.force.resize(nodes, [T::default(); 3]);
        self.change.resize(nodes, [T::default(); 3]);
    }
}

/// Returns true if the work of a force depends only on the displacements at the start and now.
fn is_steady<T: Real>(potential: &dyn Potential<T>) -> bool {
    potential.is_conservative() && potential.is_steady()
}

/// Potential of the external forces whose work does not depend on the path, J.
fn steady_potential<T: Real>(system: &System<T>, u: &[[T; 3]], moment: Moment) -> f64 {
    let steady = system.forces.active().filter(|(potential, _)| is_steady(*potential) && !potential.is_internal());
    steady.map(|(potential, _)| potential.energy(u, moment).value).sum()
}

/// Kinetic energy of the nodes with a prescribed motion, J.
fn kinetic_of_motions<T: Real>(system: &System<T>, v: &[[T; 3]]) -> f64 {
    let mut prescribed = v.to_vec();
    system.dirichlet.clear_free(&mut prescribed);
    system.mass.kinetic_energy(&prescribed)
}

/// Kinetic energy, and that of elements and internal forces, J.
fn energy<T: Real>(system: &System<T>, state: &State<T>, moment: Moment) -> f64 {
    let internal = system.forces.active().filter(|(potential, _)| potential.is_internal());
    let springs: f64 = internal.map(|(potential, _)| potential.energy(&state.u, moment).value).sum();
    system.mass.kinetic_energy(&state.v) + system.elements.energy(&state.u) + springs
}

/// Rounding error of an energy, J.
fn round_off<T: Real>(system: &System<T>) -> f64 {
    let shear = system.elements.moduli().map(|[shear, _]| shear).fold(system.spring_modulus, f64::max);
    T::EPSILON.as_f64() * shear * system.length.powi(3)
}

/// sum = x + a y
fn add_scaled<T: Real>(x: &[[T; 3]], a: f64, y: &[[T; 3]], sum: &mut [[T; 3]]) {
    let a = T::of(a);
    for (sum, (x, y)) in sum.iter_mut().zip(x.iter().zip(y)) {
        *sum = triple(|i| x[i] + a * y[i]);
    }
}
