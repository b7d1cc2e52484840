//! Forces of obstacles apart from all others: methods that take forces at a stage within the step take those of obstacles at its end.

use super::system::System;
use crate::forces::{Energy, HessianKind, Moment, Potential};
use fem_elements::Real;
use fem_elements::sparse::Block;
use fem_elements::vector::sum_of_sizes;

impl<T: Real> System<T> {
    /// Potential energy without that of obstacles, and its gradient (N).
    pub fn own_potential_and_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) -> Energy {
        gradient.fill([T::default(); 3]);
        let mut energy = Energy::of(self.profile.energies.time(|| self.elements.add_energy_and_gradient(u, gradient)));
        for (potential, timer) in self.forces.active().filter(|(potential, _)| !potential.is_obstacle()) {
            timer.time(|| potential.add_gradient(u, moment, gradient));
            energy = energy + potential.energy(u, moment);
        }
        energy
    }

    /// Energy of the obstacles, and its gradient (N).
    pub fn obstacle_energy_and_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) -> Energy {
        gradient.fill([T::default(); 3]);
        let mut energy = Energy::default();
        for (potential, timer) in self.forces.active().filter(|(potential, _)| potential.is_obstacle()) {
            timer.time(|| potential.add_gradient(u, moment, gradient));
            energy = energy + potential.energy(u, moment);
        }
        energy
    }

    /// Adds the Hessian of the external forces without that of obstacles, N/m.
    pub fn add_own_external_hessian(
        &self,
        u: &[[T; 3]],
        moment: Moment,
        kind: HessianKind,
        values: &mut [Block<T, 3>],
    ) {
        let is_own = |potential: &dyn Potential<T>| !potential.is_internal() && !potential.is_obstacle();
        for (potential, timer) in self.forces.active().filter(|(potential, _)| is_own(*potential)) {
            timer.time(|| potential.add_hessian(T::one(), u, moment, kind, &self.pattern, values));
        }
    }

    /// Adds `factor` times the Hessian of the obstacles, N/m.
    pub fn add_obstacle_hessian(
        &self,
        factor: T,
        u: &[[T; 3]],
        moment: Moment,
        kind: HessianKind,
        values: &mut [Block<T, 3>],
    ) {
        for (potential, timer) in self.forces.active().filter(|(potential, _)| potential.is_obstacle()) {
            timer.time(|| potential.add_hessian(factor, u, moment, kind, &self.pattern, values));
        }
    }

    /// Sums of the sizes of all components of the internal forces of the body and of its loads on all nodes, N. `scratch` is overwritten.
    pub fn sizes_of_forces(&self, u: &[[T; 3]], moment: Moment, scratch: &mut [[T; 3]]) -> [f64; 2] {
        scratch.fill([T::default(); 3]);
        self.elements.add_gradient(u, scratch);
        let of_kind = |is_internal: bool| {
            let is_own =
                move |potential: &dyn Potential<T>| !potential.is_obstacle() && potential.is_internal() == is_internal;
            self.forces.active().map(|(potential, _)| potential).filter(move |potential| is_own(*potential))
        };
        of_kind(true).for_each(|potential| potential.subtract_force(u, moment, scratch));
        let internal = sum_of_sizes(scratch);
        scratch.fill([T::default(); 3]);
        of_kind(false).for_each(|potential| potential.subtract_force(u, moment, scratch));
        [internal, sum_of_sizes(scratch)]
    }

    /// The largest multiple of `direction` up to which the body stays outside the obstacles.
    pub fn largest_step(&self, u: &[[T; 3]], moment: Moment, direction: &[[T; 3]]) -> f64 {
        let barriers = self.forces.active().filter_map(|(potential, _)| potential.barrier());
        barriers.map(|barrier| barrier.largest_step(u, moment, direction)).fold(f64::INFINITY, f64::min)
    }
}
