//! Equilibrium of a body that can move as a rigid body and that obstacles alone hold.
//!
//! Its energy V has no unique minimum, and its stiffness is singular. So the proximal point method (Rockafellar, Monotone Operators and
//! the Proximal Point Algorithm, 1976) minimizes V(u) + σ/2 ‖u − uₖ‖²_M for uₖ₊₁, again and again. Each minimum is unique; a rigid motion
//! without a force on it does not occur, since the term keeps the centre of mass of such a body. The term ends with the residual
//! σ M (uₖ₊₁ − uₖ), which is what forces lack of balance: below a tolerance uₖ₊₁ is an equilibrium without the term.

use fem_model::simulation::Cause;

use crate::forces::Moment;
use crate::model::system::System;
use crate::newton::incremental_potential::Inertia;
use fem_elements::vector::{axpy, max_norm, sum_of_sizes};
use fem_solvers::Real;

/// The term on the mass, and where it begins.
pub struct Proximal<T> {
    /// uₖ, m.
    pub u: Vec<[T; 3]>,
    zero: Vec<[T; 3]>,
    residual: Vec<[T; 3]>,
    forces: Vec<[T; 3]>,
    /// About the square of the lowest angular frequency of the body, 1/s².
    scale: f64,
    /// σ in units of `scale`.
    sigma: f64,
    /// Residual of the last iteration, N.
    before: f64,
    iterations: usize,
    /// Largest residual, as a part of the forces.
    tolerance: f64,
    /// Shear modulus times squared length, N.
    stiffness: f64,
}

/// σ at the start, after some iterations, and where the residual does not decrease: a body that falls onto an obstacle.
const SIGMA: [f64; 3] = [0.1, 1e-5, 1e-10];

/// Largest residual, as a part of the forces, and the same in machine epsilons.
const TOLERANCE: f64 = 1e-9;
const ROUNDING: f64 = 100.0;

/// Forces in a body without loads that count as none, in shear moduli times squared lengths.
const NEGLIGIBLE: f64 = 1e-3;

/// Lengths of the body by which an iteration may move it, and by which it may move before it counts as unstoppable.
const FEW: f64 = 10.0;
const FARTHEST: f64 = 100.0;

/// Largest number of iterations.
const MOST: usize = 200;

impl<T: Real> Proximal<T> {
    /// Allocates its vectors for a body of this shear modulus, Pa.
    pub fn new(system: &System<T>, modulus: f64) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self {
            u: zero(),
            zero: zero(),
            residual: zero(),
            forces: zero(),
            scale: modulus * system.length / system.total_mass,
            sigma: SIGMA[0],
            before: f64::INFINITY,
            iterations: 0,
            tolerance: f64::max(TOLERANCE, ROUNDING * T::EPSILON.as_f64()),
            stiffness: modulus * system.length * system.length,
        }
    }

    /// Begins at displacements, m.
    pub fn begin(&mut self, u: &[[T; 3]]) {
        self.u.copy_from_slice(u);
        (self.sigma, self.before, self.iterations) = (SIGMA[0], f64::INFINITY, 0);
    }

    /// The term on the mass of the next iteration.
    pub fn inertia(&self) -> Inertia<'_, T> {
        Inertia {
            inertial: &self.zero,
            over_dt2: T::of(self.sigma * self.scale),
            damping: None,
            still: None,
            stiffness_at: None,
            step_end: None,
        }
    }

    /// Takes the increment of an iteration. Returns true if its end is in equilibrium without the term.
    pub fn review(&mut self, system: &System<T>, end: Moment, step: &[[T; 3]]) -> Result<bool, Cause> {
        axpy(1.0, step, &mut self.u);
        self.residual.fill([T::default(); 3]);
        system.add_mass_times(T::of(self.sigma * self.scale), step, &mut self.residual);
        system.dirichlet.clear_constrained(&mut self.residual);
        let left = sum_of_sizes(&self.residual);
        let internal = system.size_of_internal_forces(&self.u, end, &mut self.forces);
        let loads = system.size_of_loads(&self.u, end, &mut self.forces);
        let size = f64::max(internal, loads);
        if left <= self.tolerance * size || (loads == 0.0 && left <= NEGLIGIBLE * self.tolerance * self.stiffness) {
            return Ok(true);
        }
        self.iterations += 1;
        if self.iterations == MOST || max_norm(&self.u) > FARTHEST * system.length {
            return Err(Cause::Adrift { force: left });
        }
        // This force does not move the body by more than a few lengths at once.
        let is_moving = left > 0.5 * self.before;
        let least = f64::max(left / (FEW * self.stiffness), if is_moving { SIGMA[2] } else { SIGMA[1] });
        self.sigma = least.max(0.1 * self.sigma);
        self.before = left;
        Ok(false)
    }
}
