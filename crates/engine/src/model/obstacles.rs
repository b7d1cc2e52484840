//! Forces of obstacles apart from all others: methods that take forces at a stage within the step take those of obstacles at its end.

use super::system::System;
use crate::forces::{Energy, Moment};
use fem_elements::vector::sum_of_sizes;
use fem_solvers::Real;

impl<T: Real> System<T> {
    /// Potential energy without that of obstacles, and its gradient (N).
    pub fn own_potential_and_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) -> Energy {
        gradient.fill([T::default(); 3]);
        let elastic = self.profile.energies.time(|| self.elements.add_energy_and_gradient(u, gradient));
        self.add_forces(false, Energy::of(elastic), (u, moment), gradient)
    }

    /// Energy of the obstacles, and its gradient (N).
    pub fn obstacle_energy_and_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) -> Energy {
        gradient.fill([T::default(); 3]);
        self.add_forces(true, Energy::default(), (u, moment), gradient)
    }

    /// Adds the gradient of the obstacles or of all other forces, and their energy to that of the body.
    fn add_forces(
        &self,
        obstacles: bool,
        body: Energy,
        (u, moment): (&[[T; 3]], Moment),
        gradient: &mut [[T; 3]],
    ) -> Energy {
        let forces = self.forces.active().filter(|(potential, _)| potential.is_obstacle() == obstacles);
        forces.fold(body, |energy, (potential, timer)| {
            timer.time(|| potential.add_gradient(u, moment, gradient));
            energy + potential.energy(u, moment)
        })
    }

    /// Sum of the sizes of all components of the internal forces of the body on all nodes, N. `scratch` is overwritten.
    pub fn size_of_internal_forces(&self, u: &[[T; 3]], moment: Moment, scratch: &mut [[T; 3]]) -> f64 {
        scratch.fill([T::default(); 3]);
        self.elements.add_gradient(u, scratch);
        self.size_with(true, u, moment, scratch)
    }

    /// The same of its loads.
    pub fn size_of_loads(&self, u: &[[T; 3]], moment: Moment, scratch: &mut [[T; 3]]) -> f64 {
        scratch.fill([T::default(); 3]);
        self.size_with(false, u, moment, scratch)
    }

    /// The same of what `scratch` holds together with internal forces beside the elements, or with loads.
    fn size_with(&self, internal: bool, u: &[[T; 3]], moment: Moment, scratch: &mut [[T; 3]]) -> f64 {
        let own = self.forces.active().map(|(force, _)| force).filter(|force| !force.is_obstacle());
        own.filter(|force| force.is_internal() == internal).for_each(|force| force.subtract_force(u, moment, scratch));
        sum_of_sizes(scratch)
    }

    /// The largest multiple of `direction` up to which the body stays outside the obstacles.
    pub fn largest_step(&self, u: &[[T; 3]], moment: Moment, direction: &[[T; 3]]) -> f64 {
        let barriers = self.forces.active().filter_map(|(potential, _)| potential.barrier());
        barriers.map(|barrier| barrier.largest_step(u, moment, direction)).fold(f64::INFINITY, f64::min)
    }
}
