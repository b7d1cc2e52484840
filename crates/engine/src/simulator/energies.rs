//! Energies of the parts of a body, for the energy ledger.

use crate::forces::{Moment, Potential};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::{axpy, dot};
use fem_solvers::Real;

/// Bounds of the motion of a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Of the squared speed of a node, m²/s².
    pub squared_speed: f64,
    /// Of the kinetic energy, J: no node's velocity is multiplied by that of another.
    pub kinetic: f64,
}

impl Bounds {
    /// Those of a state.
    pub(super) fn of<T: Real>(system: &System<T>, state: &State<T>) -> Self {
        Self { squared_speed: state.largest_squared_speed(), kinetic: system.mass.kinetic_energy_bound(&state.v) }
    }
}

/// Returns true for a force whose energy the body stores: springs, and the barrier of obstacles.
pub(super) fn is_stored<T: Real>(potential: &dyn Potential<T>) -> bool {
    !potential.is_dissipative() && (potential.is_internal() || potential.is_obstacle())
}

/// Returns true for a load whose work depends only on the displacements at the start and now.
pub(super) fn is_steady_load<T: Real>(potential: &dyn Potential<T>) -> bool {
    !is_stored(potential) && potential.is_conservative() && potential.is_steady()
}

/// Returns true for a load whose work depends on the path.
pub(super) fn is_changing_load<T: Real>(potential: &dyn Potential<T>) -> bool {
    !is_stored(potential) && !is_steady_load(potential) && !potential.is_dissipative()
}

/// Elastic energy of elements and springs, and that of the barriers of obstacles, J.
pub(super) fn stored<T: Real>(system: &System<T>, u: &[[T; 3]], moment: Moment) -> f64 {
    let stored = system.forces.active().filter(|(potential, _)| is_stored(*potential));
    system.elements.energy(u) + stored.map(|(potential, _)| potential.energy(u, moment).value).sum::<f64>()
}

/// Potential of the loads whose work does not depend on the path, J.
pub(super) fn steady_potential<T: Real>(system: &System<T>, u: &[[T; 3]], moment: Moment) -> f64 {
    let of_load = |load: &dyn Potential<T>| match load.constant() {
        Some(force) => -dot(force, u),
        None => load.energy(u, moment).value,
    };
    steady_loads(system).map(of_load).sum()
}

/// The same potential now and after a further step of `dt` seconds at the present velocities, J. `room` is overwritten.
pub(super) fn steady_potentials<T: Real>(
    system: &System<T>,
    State { u, v, .. }: &State<T>,
    dt: f64,
    moment: Moment,
    room: &mut Vec<[T; 3]>,
) -> [f64; 2] {
    let [mut now, mut ahead] = [0.0; 2];
    for load in steady_loads(system) {
        if let Some(force) = load.constant() {
            let potential = -dot(force, u);
            now += potential;
            ahead += potential - dt * dot(force, v);
        } else {
            room.clone_from(u);
            axpy(dt, v, room);
            now += load.energy(u, moment).value;
            ahead += load.energy(room, moment).value;
        }
    }
    [now, ahead]
}

fn steady_loads<T: Real>(system: &System<T>) -> impl Iterator<Item = &dyn Potential<T>> {
    system.forces.active().map(|(potential, _)| potential).filter(|potential| is_steady_load(*potential))
}

/// Energy that plastic flow has dissipated, J.
pub(super) fn plastic<T: Real>(system: &System<T>) -> f64 {
    system.elements.plasticity().map_or(0.0, |plasticity| plasticity.dissipated())
}

/// Kinetic energy of the nodes with a prescribed motion, J. `room` is overwritten.
pub(super) fn kinetic_of_motions<T: Real>(system: &System<T>, v: &[[T; 3]], room: &mut Vec<[T; 3]>) -> f64 {
    room.clear();
    room.extend_from_slice(v);
    system.dirichlet.clear_free(room);
    system.mass.kinetic_energy(room)
}

/// Rounding error of an energy, J.
pub(super) fn rounding<T: Real>(system: &System<T>, u: &[[T; 3]]) -> f64 {
    let shear = system.elements.moduli().map(|[shear, _]| shear).fold(system.spring_modulus, f64::max);
    T::EPSILON.as_f64() * (shear * system.length.powi(3)).max(system.elements.cancelled(u))
}
