//! The Hessian that directions come from: as it is, projected, or shifted.

use super::{Factor, Newton};
use crate::newton::incremental_potential::IncrementalPotential;
use crate::number::Real;
use crate::vector::max_norm;
use fem_scene::Projection;
use fem_scene::simulation::{Cause, Counters};

impl<T: Real> Newton<T> {
    /// Writes into `w` the step to where the energy, to second order about w = 0, is least when held directions step by `led`: a
    /// good start, because elements at a clamp are not squashed.
    pub fn predict(
        &mut self,
        objective: &IncrementalPotential<T>,
        led: &[[T; 3]],
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        w.fill([T::default(); 3]);
        self.forget();
        objective.linear_slope(led, &mut self.gradient, &mut self.scratch);
        counters.force_assemblies += 1;
        self.prepare(objective, w, false, counters)?;
        for (right, g) in self.right.iter_mut().zip(&self.gradient) {
            *right = g.map(|g| -g);
        }
        let tolerance = self.limits.solver_tolerance.max(1e-6);
        self.solver.solve(&self.values, &self.right, w, tolerance).map_err(Cause::Solver)?;
        objective.system.held.copy(led, w);
        Ok(())
    }

    /// The Hessian at w, and its factor.
    pub(super) fn prepare(
        &mut self,
        objective: &IncrementalPotential<T>,
        w: &[[T; 3]],
        must_project: bool,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        self.history.clear();
        if !must_project && self.limits.projection != Projection::Always {
            counters.stiffness_assemblies += 1;
            objective.hessian(w, false, &mut self.values, &mut self.scratch);
            if self.prepare_solver(counters) {
                self.factor = Factor::Fresh;
                return Ok(());
            }
        }
        if self.limits.projection != Projection::Never {
            counters.stiffness_assemblies += 1;
            counters.projections += objective.system.elements.count;
            objective.hessian(w, true, &mut self.values, &mut self.scratch);
            if self.prepare_solver(counters) {
                self.factor = Factor::FreshProjected;
                return Ok(());
            }
        }
        self.prepare_shifted(objective, counters)
    }

    /// A factor of the values, or a preconditioner for them where the one that is kept is worn out. False where there is none.
    fn prepare_solver(&mut self, counters: &mut Counters) -> bool {
        if self.solver.is_iterative() && !self.solver.copies_matrix() && self.iterations_at_first.is_some() {
            return true;
        }
        counters.factorizations += 1;
        self.is_new = true;
        self.solver.prepare(&self.values).is_ok()
    }

    /// Adds a growing multiple of the largest diagonal entry to the diagonal.
    fn prepare_shifted(&mut self, objective: &IncrementalPotential<T>, counters: &mut Counters) -> Result<(), Cause> {
        let diagonal: Vec<usize> = objective.system.pattern.diagonal().collect();
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
            if self.solver.prepare(&self.values).is_ok() {
                self.factor = Factor::FreshProjected;
                return Ok(());
            }
            shift *= 10.0;
        }
        Err(Cause::Stuck { unbalanced: max_norm(&self.gradient) })
    }
}
