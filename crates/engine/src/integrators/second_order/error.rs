//! The estimate of a step's error.

use super::SecondOrder;
use super::scheme::Scheme;
use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::Real;
use fem_elements::vector::{axpy, max_norm, scale, triple};
use fem_model::simulation::Cause;

impl Scheme {
    /// |C| of the local error C dt³ u‴ of the displacements of a step with this ratio to the one before, small vibrations assumed.
    ///
    /// Newmark: Zienkiewicz, Xie, A Simple Error Estimator and Adaptive Time Stepping Procedure for Dynamic Analysis (1991); in the
    /// generalized-α method accelerations are those of (α_f − α_m) dt before. BDF2: Hairer, Nørsett, Wanner, Solving Ordinary
    /// Differential Equations I (1993), III.5.
    fn error_constant(self, ratio: Option<f64>) -> f64 {
        match (self, ratio) {
            (Self::ImplicitMidpoint, _) => 1.0 / 12.0,
            (Self::Newmark(parameters), _) => parameters.beta - 1.0 / 6.0,
            (Self::GeneralizedAlpha(rho_inf), _) => {
                let (alpha_m, alpha_f) = ((2.0 * rho_inf - 1.0) / (rho_inf + 1.0), rho_inf / (rho_inf + 1.0));
                0.25 * (1.0 - alpha_m + alpha_f).powi(2) - 1.0 / 6.0 - 0.5 * (alpha_f - alpha_m)
            }
            (Self::Bdf2, Some(r)) => (1.0 + r).powi(2) / (6.0 * r * (1.0 + 2.0 * r)),
            // 1/6 − 3γ² + 2γ³ of Alexander's method, γ = 1 − 1/√2.
            (Self::Bdf2, None) => 0.0404,
        }
    }
}

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
