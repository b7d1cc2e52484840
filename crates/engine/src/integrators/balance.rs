//! The balance of forces in equilibrium: beside the size of Newton's last update, which says little where elements are nearly flat, or far stiffer
//! than others. There an update can be as small as rounding errors far away from equilibrium.

use fem_model::simulation::Cause;

use crate::forces::Moment;
use crate::model::system::System;
use fem_elements::vector::{axpy, max_norm, sum_of_sizes};
use fem_solvers::Real;

/// Largest sum of the sizes of unbalanced forces, as a part of loads or reactions.
const UNBALANCED: f64 = 1e-3;

/// The same as a part of the stresses in all elements, at least, and in tolerances of Newton's method: a body without loads may have stresses.
const STRESSES: (f64, f64) = (1e-6, 1e2);

/// Rounding errors of displacements, in machine epsilons.
const ROUNDING: f64 = 10.0;

/// Sums of the sizes of forces, N.
pub struct Sizes {
    /// Unbalanced forces on free degrees of freedom.
    pub unbalanced: f64,
    /// External forces, without those of obstacles.
    pub loads: f64,
    /// The larger one of loads and reactions.
    pub largest: f64,
}

/// Evaluates them. `force` holds the unbalanced forces afterwards.
pub fn sizes<T: Real>(system: &System<T>, u: &[[T; 3]], moment: Moment, force: &mut [[T; 3]]) -> Sizes {
    let loads = system.size_of_loads(u, moment, force);
    system.undamped_force(u, moment, force);
    let all = sum_of_sizes(force);
    system.dirichlet.clear_constrained(force);
    let unbalanced = sum_of_sizes(force);
    Sizes { unbalanced, loads, largest: f64::max(loads, all - unbalanced) }
}

/// Vectors for its evaluation.
pub struct Balance<T> {
    u: Vec<[T; 3]>,
    force: Vec<[T; 3]>,
}

impl<T: Real> Balance<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self { u: zero(), force: zero() }
    }

    /// An error, if forces at the end of an increment from a start (m) are not in balance. They are as far as rounding errors and
    /// the tolerance of Newton's method let them be.
    pub fn check(
        &mut self,
        system: &System<T>,
        (start, increment): (&[[T; 3]], &[[T; 3]]),
        end: Moment,
        tolerance: f64,
    ) -> Result<(), Cause> {
        self.u.copy_from_slice(start);
        axpy(1.0, increment, &mut self.u);
        let Sizes { unbalanced, loads, largest } = sizes(system, &self.u, end, &mut self.force);
        // NaN fails the comparisons.
        if unbalanced <= UNBALANCED * largest {
            return Ok(());
        }
        let [stresses, rounding] = sizes_in_elements(system, &self.u, end);
        let part = f64::max(STRESSES.0, STRESSES.1 * tolerance);
        let is_rounding = unbalanced <= ROUNDING * rounding;
        let is_allowed = is_rounding || unbalanced <= part * stresses;
        // Reactions alone may be nothing but errors, as those of a body that is turned; those to loads should be the loads.
        let shows = loads > 0.0 && !system.dirichlet.has_motion() && resultant(&self.force) > UNBALANCED * loads;
        let unbalanced = max_norm(&self.force);
        match (is_allowed && !shows, is_rounding) {
            (true, _) => Ok(()),
            (false, true) => Err(Cause::RoundOff { unbalanced }),
            (false, false) => Err(Cause::Stuck { unbalanced }),
        }
    }
}

/// Size of the sum of forces, N: the error of the reactions.
fn resultant<T: Real>(force: &[[T; 3]]) -> f64 {
    let along = |i: usize| force.iter().map(|force| force[i].as_f64()).sum::<f64>();
    (0..3).map(|i| along(i).abs()).fold(0.0, f64::max)
}

/// Sums over the elements of the forces of their stresses, and of those that rounding errors of displacements cause, N.
fn sizes_in_elements<T: Real>(system: &System<T>, u: &[[T; 3]], moment: Moment) -> [f64; 2] {
    let volumes = system.shape.mesh.volumes();
    let stresses = system.stresses(u, moment);
    let forces = stresses.iter().zip(&volumes).map(|(stress, volume)| stress.norm() * volume.powf(2.0 / 3.0));
    let lengths: f64 = volumes.iter().map(|volume| volume.cbrt()).sum();
    let modulus = system.elements.moduli().map(|[shear, bulk]| bulk + 4.0 / 3.0 * shear);
    let modulus = modulus.fold(system.spring_modulus, f64::max);
    [forces.sum(), T::EPSILON.as_f64() * max_norm(u) * modulus * lengths]
}
