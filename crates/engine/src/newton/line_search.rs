//! How far to go along a direction.

use super::{Iterate, Newton};
use crate::newton::incremental_potential::IncrementalPotential;
use crate::number::Real;
use crate::vector::{axpy, dot, max_norm};
use fem_scene::simulation::Counters;

/// Part of the energy's terms that is round-off.
const ROUND_OFF: f64 = 32.0;

/// Sufficient decrease, Armijo (1966).
const DECREASE: f64 = 1e-4;

/// Part of its smallest J that a body keeps in a step longer than so many lengths of the body.
const KEPT: f64 = 0.1;
const LONG: f64 = 1e-3;

/// Smallest part of a direction that is tried.
const SHORTEST: f64 = 1e-8;

impl<T: Real> Newton<T> {
    /// The largest of 1, ½, ¼ … of the direction that goes downhill; what it leads to is in `next` and `next_gradient`.
    pub(super) fn search(
        &mut self,
        objective: &IncrementalPotential<T>,
        w: &[[T; 3]],
        at: &mut Iterate,
        slope: f64,
        counters: &mut Counters,
    ) -> Option<f64> {
        let (mut length, mut cancelled) = (1.0, None);
        let least_J = self.least_J(objective, w);
        while length >= SHORTEST {
            self.next.copy_from_slice(w);
            axpy(length, &self.direction, &mut self.next);
            counters.energy_evaluations += 1;
            counters.force_assemblies += 1;
            let energy = objective.energy_and_gradient(&self.next, &mut self.next_gradient, &mut self.scratch);
            let change = energy.value - at.energy.value;
            // Where a change drowns in round-off, the slope has to have become flatter. An infinite energy is no round-off of its
            // own, and NaN fails both.
            let mut is_flatter = || {
                let cancelled = *cancelled.get_or_insert_with(|| objective.cancelled(w, &mut self.scratch));
                let round_off = ROUND_OFF * T::EPSILON.as_f64() * (at.energy.terms + energy.terms + cancelled);
                let drowns = change.is_finite() && change.abs() <= round_off;
                drowns && dot(&self.next_gradient, &self.direction).abs() <= 0.9 * slope.abs()
            };
            let is_lower = change <= DECREASE * length * slope || is_flatter();
            if is_lower && least_J.is_none_or(|least| objective.min_det_F(&self.next, &mut self.scratch) >= least) {
                at.energy = energy;
                return Some(length);
            }
            counters.line_search_backtracks += 1;
            length *= 0.5;
        }
        None
    }

    /// The J that no element may come below along the direction; none where the step is too short to matter.
    ///
    /// A law that forbids J ≤ 0 may still have finite energy in a point: a long step must not leap across the forces that
    /// would have stopped a shorter one.
    fn least_J(&mut self, objective: &IncrementalPotential<T>, w: &[[T; 3]]) -> Option<f64> {
        let is_long =
            !objective.system.law.allows_inversion() && max_norm(&self.direction) > LONG * objective.system.length;
        is_long.then(|| KEPT * objective.min_det_F(w, &mut self.scratch))
    }
}
