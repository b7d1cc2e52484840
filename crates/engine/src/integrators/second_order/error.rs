//! The estimate of a step's error.

use super::SecondOrder;
use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::{axpy, max_norm, scale, triple};
use fem_model::simulation::Cause;
use fem_solvers::Real;

impl<T: Real> SecondOrder<T> {
    /// Keeps the mean acceleration of the step for the estimate of the next one, without that of obstacles: impacts have no third
    /// derivative, and are of first order in any case.
    pub(super) fn keep_mean(&mut self, system: &System<T>, state: &State<T>, dt: f64) -> Result<(), Cause> {
        let Self { start, next, before, .. } = self;
        let over_dt = T::of(1.0 / dt);
        for (mean, (after, before)) in next.mean.iter_mut().zip(state.v.iter().zip(&*before)) {
            *mean = triple(|i| (after[i] - before[i]) * over_dt);
        }
        next.age = Some(0.5 * dt);
        if let Some(by_obstacles) = start.by_obstacles(system, &state.u, Moment::at(state.time + dt))? {
            axpy(-1.0, by_obstacles, &mut next.mean);
        }
        Ok(())
    }

    /// Estimates the error of the displacements that a step of `dt` seconds has made, m, from the change of the mean accelerations:
    /// C dt³ Δa/Δt. Vibrations much faster than the step are left out as far as the step damps them: the estimate is multiplied by
    /// (M + τ² K)⁻¹ M, Hosea, Shampine, Analysis and Implementation of TR-BDF2 (1996).
    pub(super) fn estimate(&mut self, system: &System<T>, dt: f64, ratio: Option<f64>) {
        let Self { scheme, newton, known, next, still: error, velocity: right, .. } = self;
        let Some(age) = known.age else { return };
        error.copy_from_slice(&next.mean);
        axpy(-1.0, &known.mean, error);
        system.dirichlet.clear_constrained(error);
        scale(scheme.error_constant(ratio).abs() * dt.powi(3) / (0.5 * dt + age), error);
        newton.smooth(system, right, error);
        self.error = Some(max_norm(&self.still));
    }
}
