//! Energies of the parts of a body, for the energy ledger.

use crate::forces::{Moment, Potential};
use crate::model::system::System;
use fem_elements::Real;

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
    let steady = system.forces.active().filter(|(potential, _)| is_steady_load(*potential));
    steady.map(|(potential, _)| potential.energy(u, moment).value).sum()
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
