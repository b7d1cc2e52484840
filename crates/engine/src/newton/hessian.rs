//! The Hessian of an iteration and its factor: exact, projected, or with a shifted diagonal.

use fem_model::Projection;
use fem_model::simulation::{Breakdown, Cause, Counters};

use super::incremental_potential::IncrementalPotential;
use super::{Factor, Newton};
use crate::forces::HessianKind;
use crate::model::system::System;
use fem_elements::vector::max_norm;
use fem_solvers::Real;

/// Change of 1/τ² up to which a factor is kept: with another one, an update would be too short or too long by about that.
const SAME: f64 = 1.5;

/// Relative residual of a solution that needs a few digits.
const SMOOTHED: f64 = 0.05;

impl<T: Real> Newton<T> {
    /// Writes into `w` the minimum of the energy to second order about w = 0 with the prescribed increments of the constrained
    /// degrees of freedom: a good initial guess, because it does not compress the elements at the constrained nodes.
    pub fn predict(
        &mut self,
        potential: &IncrementalPotential<T>,
        prescribed: &[[T; 3]],
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        w.fill([T::default(); 3]);
        self.forget();
        if let Some(mixed) = potential.system.forces.mixed() {
            return self.predict_with_pressures(potential, mixed, prescribed, w, counters);
        }
        potential.linearized_gradient(prescribed, &mut self.gradient, &mut self.workspace);
        counters.force_assemblies += 1;
        self.prepare(potential, w, HessianKind::Exact, counters)?;
        for (right, g) in self.right.iter_mut().zip(&self.gradient) {
            *right = g.map(|g| -g);
        }
        let tolerance = self.limits.solver_tolerance.max(1e-6);
        self.solver.solve(&self.values, &self.right, w, tolerance).map_err(Cause::Solver)?;
        potential.system.dirichlet.copy_constrained(prescribed, w);
        Ok(())
    }

    /// Returns true if the kept Hessian has about the inertia of this step.
    pub(super) fn serves(&self, potential: &IncrementalPotential<T>) -> bool {
        let inertia = potential.increment.inertia.map(|inertia| inertia.over_dt2);
        self.inertia_of_hessian
            .zip(inertia)
            .is_none_or(|(kept, now)| now <= T::of(SAME) * kept && kept <= T::of(SAME) * now)
    }

    /// Replaces x by H⁻¹ M x/τ² with the kept Hessian H of an earlier iterate and its τ, to a few digits: the part of x that varies
    /// slowly stays. Does not change x without such a Hessian. Overwrites `right`.
    pub fn smooth(&mut self, system: &System<T>, right: &mut [[T; 3]], x: &mut [[T; 3]]) {
        let Some(over_dt2) = self.inertia_of_hessian else { return };
        right.fill([T::default(); 3]);
        system.add_mass_times(over_dt2, x, right);
        system.dirichlet.clear_constrained(right);
        self.direction.fill([T::default(); 3]);
        let is_solved = if self.solver.is_iterative() {
            self.solver.solve(&self.values, right, &mut self.direction, SMOOTHED).is_ok()
        } else {
            self.solver.apply(right, &mut self.direction);
            true
        };
        if is_solved {
            x.copy_from_slice(&self.direction);
        }
    }

    /// Assembles the Hessian at w and factors it: the exact one if `kind` and the settings allow and it is positive definite, else
    /// the projected one, else that one shifted.
    pub(super) fn prepare(
        &mut self,
        potential: &IncrementalPotential<T>,
        w: &[[T; 3]],
        kind: HessianKind,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        self.lbfgs.clear();
        if kind == HessianKind::Exact && self.limits.projection != Projection::Always {
            counters.stiffness_assemblies += 1;
            let factored = self.assemble_where_it_is_solved(potential, w, counters).unwrap_or_else(|| {
                potential.hessian(w, HessianKind::Exact, &mut self.values, &mut self.workspace);
                self.factor_values(potential, counters)
            });
            if is_usable(factored)? {
                self.factor = Factor::Fresh;
                return Ok(());
            }
        }
        if self.limits.projection != Projection::Never {
            counters.stiffness_assemblies += 1;
            counters.projections += potential.system.elements.count();
            potential.hessian(w, HessianKind::Projected, &mut self.values, &mut self.workspace);
            if is_usable(self.factor_values(potential, counters))? {
                self.factor = Factor::FreshProjected;
                return Ok(());
            }
        }
        self.factor_shifted(potential, counters)
    }

    /// Lets the solver assemble the exact Hessian and prepare it, if it can.
    fn assemble_where_it_is_solved(
        &mut self,
        potential: &IncrementalPotential<T>,
        w: &[[T; 3]],
        counters: &mut Counters,
    ) -> Option<Result<(), Breakdown>> {
        if !self.solver.assembles() {
            return None;
        }
        let Self { solver, values, workspace, .. } = self;
        let assembled = potential.with_sum(w, values, workspace, |sum| solver.assemble(sum));
        counters.factorizations += 1;
        self.inertia_of_hessian = potential.increment.inertia.map(|inertia| inertia.over_dt2);
        self.is_new_preconditioner = true;
        Some(assembled)
    }

    /// Factors the assembled values, or makes a preconditioner for them unless the kept one is still good enough.
    fn factor_values(&mut self, potential: &IncrementalPotential<T>, counters: &mut Counters) -> Result<(), Breakdown> {
        self.inertia_of_hessian = potential.increment.inertia.map(|inertia| inertia.over_dt2);
        if self.solver.is_iterative() && !self.solver.copies_matrix() && self.first_iterations.is_some() {
            return Ok(());
        }
        counters.factorizations += 1;
        self.is_new_preconditioner = true;
        self.solver.prepare(&self.values)
    }

    /// Adds a growing multiple of the largest diagonal entry to the diagonal until the factorization succeeds.
    fn factor_shifted(&mut self, potential: &IncrementalPotential<T>, counters: &mut Counters) -> Result<(), Cause> {
        let diagonal: Vec<usize> = potential.system.pattern.diagonal().collect();
        let entries = diagonal.iter().flat_map(|&block| (0..3).map(move |i| (block, i)));
        let largest = entries.map(|(block, i)| self.values[block][i][i].as_f64().abs()).fold(0.0, f64::max);
        let mut shift = 1e-8 * largest;
        while shift.is_finite() && shift <= 1e4 * largest {
            for &block in &diagonal {
                for i in 0..3 {
                    self.values[block][i][i] += T::of(shift);
                }
            }
            counters.factorizations += 1;
            if is_usable(self.solver.prepare(&self.values))? {
                self.factor = Factor::FreshProjected;
                return Ok(());
            }
            shift *= 10.0;
        }
        Err(Cause::Stuck { unbalanced: max_norm(&self.gradient) })
    }
}

/// Returns true if the matrix could be factored. An error means that no other matrix could be factored either.
fn is_usable(factored: Result<(), Breakdown>) -> Result<bool, Cause> {
    match factored {
        Err(breakdown) if breakdown.is_of_machine() => Err(Cause::Solver(breakdown)),
        factored => Ok(factored.is_ok()),
    }
}
