//! M⁻¹ f over the free degrees of freedom.

use crate::model::mass::Mass;
use crate::model::system::System;
use fem_elements::vector::{axpy, dot, norm, subtract_from, xpby};
use fem_model::simulation::{Breakdown, Cause};
use fem_solvers::Real;

/// Division by a lumped mass; conjugate gradients with the diagonal as preconditioner for a consistent one. For tetrahedra the
/// spectrum of D⁻¹ M lies in [½, 5/2] on any mesh, Wathen, Realistic Eigenvalue Bounds for the Galerkin Mass Matrix (1987): some
/// thirty iterations give all digits.
#[derive(Clone, Debug)]
pub struct MassInverse<T> {
    /// One over each entry of the diagonal, 1/kg.
    inverse: Vec<T>,
    /// r, z, p and M p; empty for a lumped mass.
    work: [Vec<[T; 3]>; 4],
}

/// Relative residual to converge to, or this many machine epsilons.
const TOLERANCE: (f64, f64) = (1e-13, 8.0);

/// Largest number of iterations.
const MOST: usize = 500;

impl<T: Real> MassInverse<T> {
    /// Prepares the inverse of a mass matrix.
    pub fn new(mass: &Mass<T>) -> Self {
        let inverse: Vec<T> = mass.diagonal().into_iter().map(|mass| T::one() / mass).collect();
        let length = if matches!(mass, Mass::Lumped(_)) { 0 } else { inverse.len() };
        Self { inverse, work: std::array::from_fn(|_| vec![[T::default(); 3]; length]) }
    }

    /// Solves M a = f with zero entries at constrained degrees of freedom; overwrites f.
    pub fn solve(&mut self, system: &System<T>, f: &mut [[T; 3]], a: &mut [[T; 3]]) -> Result<(), Cause> {
        system.dirichlet.clear_constrained(f);
        self.divide(f, a);
        if matches!(system.mass, Mass::Lumped(_)) {
            return Ok(());
        }
        self.iterate(system, f, a).map_err(Cause::Solver)
    }

    fn divide(&self, f: &[[T; 3]], a: &mut [[T; 3]]) {
        for ((a, f), &inverse) in a.iter_mut().zip(f).zip(&self.inverse) {
            *a = f.map(|f| f * inverse);
        }
    }

    /// Conjugate gradients, Hestenes and Stiefel (1952), from the initial guess in `a`.
    fn iterate(&mut self, system: &System<T>, f: &[[T; 3]], a: &mut [[T; 3]]) -> Result<(), Breakdown> {
        let size = norm(f);
        if !size.is_finite() {
            // The iteration would accept its guess. An acceleration that is not finite ends the run.
            a.as_flattened_mut().fill(T::of(f64::NAN));
            return Ok(());
        }
        let [mut r, mut z, mut p, mut q] = std::mem::take(&mut self.work);
        let times = |x: &[[T; 3]], y: &mut [[T; 3]]| {
            y.fill([T::default(); 3]);
            system.mass.add_times(T::one(), x, y);
            system.dirichlet.clear_constrained(y);
        };
        times(a, &mut r);
        subtract_from(f, &mut r);
        self.divide(&r, &mut z);
        p.copy_from_slice(&z);
        let target = TOLERANCE.0.max(TOLERANCE.1 * T::EPSILON.as_f64()) * size;
        let (mut rz, mut residual, mut left) = (dot(&r, &z), norm(&r), MOST);
        while residual > target && left > 0 {
            times(&p, &mut q);
            let length = rz / dot(&p, &q);
            axpy(length, &p, a);
            axpy(-length, &q, &mut r);
            self.divide(&r, &mut z);
            let next = dot(&r, &z);
            xpby(&z, next / rz, &mut p);
            (rz, residual, left) = (next, norm(&r), left - 1);
        }
        self.work = [r, z, p, q];
        if residual > target { Err(Breakdown::NotConverged { residual: residual / size }) } else { Ok(()) }
    }
}
