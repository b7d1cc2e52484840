//! Backtracking line search: sufficient decrease of the energy, and a minimum of det F.

use fem_model::simulation::Counters;

use super::{Iterate, Newton};
use crate::newton::incremental_potential::{IncrementalPotential, Workspace};
use fem_elements::vector::{axpy, dot, max_norm};
use fem_solvers::Real;

/// Part of the energy's terms that is rounding error, in units of the machine epsilon.
const ROUND_OFF: f64 = 32.0;

/// Minimum of det F below which its rounding error, relative to itself, dominates that of the energy.
const NEARLY_FLAT: f64 = 1e-2;

/// Sufficient decrease, Armijo (1966).
const DECREASE: f64 = 1e-4;

/// Part of the minimum of det F that an update keeps where it is longer than so many lengths of the body.
const KEPT: f64 = 0.1;
const LONG: f64 = 1e-3;

/// Smallest step length that is tried.
const SHORTEST: f64 = 1e-8;

/// Part of the largest feasible step that is tried first.
const SAFETY: f64 = 0.9;

impl<T: Real> Newton<T> {
    /// Returns the largest step length 1, ½, ¼ … of the direction that decreases the energy, and leaves the new point in
    /// `next` and its gradient in `next_gradient`. `derivative` is the directional derivative.
    pub(super) fn line_search(
        &mut self,
        potential: &IncrementalPotential<T>,
        w: &[[T; 3]],
        at: &mut Iterate,
        derivative: f64,
        counters: &mut Counters,
    ) -> Option<f64> {
        let feasible = SAFETY * potential.largest_step(w, &self.direction, &mut self.workspace);
        let (mut length, mut cancelled) = (f64::min(1.0, feasible), None);
        at.left_out = (1.0 - length) * max_norm(&self.direction);
        let lower_bound = self.lower_bound_of_det_F(potential, w);
        while length >= SHORTEST {
            self.next.copy_from_slice(w);
            axpy(length, &self.direction, &mut self.next);
            counters.energy_evaluations += 1;
            counters.force_assemblies += 1;
            let energy = potential.energy_and_gradient(&self.next, &mut self.next_gradient, &mut self.workspace);
            let change = energy.value - at.energy.value;
            // Where the change is within rounding error, the directional derivative has to decrease instead. An infinite energy is no
            // rounding error, and NaN fails both tests.
            let mut is_flatter = || {
                let (cancelled, amplified) = *cancelled.get_or_insert_with(|| {
                    (potential.cancelled(w, &mut self.workspace), amplification(potential, w, &mut self.workspace))
                });
                let terms = at.energy.terms + energy.terms + cancelled;
                let round_off = ROUND_OFF * T::EPSILON.as_f64() * amplified * terms;
                let is_rounding = change.is_finite() && change.abs() <= round_off;
                is_rounding && dot(&self.next_gradient, &self.direction).abs() <= 0.9 * derivative.abs()
            };
            let is_lower = change <= DECREASE * length * derivative || is_flatter();
            let keeps_volume = |bound: f64, workspace: &mut _| potential.min_det_F(&self.next, workspace) >= bound;
            if is_lower && lower_bound.is_none_or(|bound| keeps_volume(bound, &mut self.workspace)) {
                at.energy = energy;
                return Some(length);
            }
            counters.line_search_backtracks += 1;
            length *= 0.5;
        }
        None
    }

    /// Lower bound of det F along the direction; `None` where every law allows inversion or the step is short.
    ///
    /// A law that forbids J ≤ 0 may still have a finite energy at a point: a long step must not cross the barrier that would have
    /// stopped a shorter one.
    fn lower_bound_of_det_F(&mut self, potential: &IncrementalPotential<T>, w: &[[T; 3]]) -> Option<f64> {
        let system = potential.system;
        let is_long = !system.elements.allow_inversion() && max_norm(&self.direction) > LONG * system.length;
        is_long.then(|| KEPT * potential.min_det_F(w, &mut self.workspace))
    }
}

/// Factor by which nearly flat elements amplify the rounding error of the energy, where it has a barrier at det F = 0.
fn amplification<T: Real>(potential: &IncrementalPotential<T>, w: &[[T; 3]], workspace: &mut Workspace<T>) -> f64 {
    let has_barrier = !potential.system.elements.allow_inversion();
    if has_barrier { (NEARLY_FLAT / potential.min_det_F(w, workspace)).max(1.0) } else { 1.0 }
}
