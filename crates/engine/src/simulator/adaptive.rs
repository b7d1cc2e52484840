//! Adaptive steps: a time step in parts whose size follows an estimate of their error.
//!
//! The estimated error of the displacements that a part of h seconds makes must not exceed tolerance · length · h/dt, so that the
//! parts of a step of dt add no more than tolerance · length. The step is chosen by a PI controller: Gustafsson, Lundh, Söderlind, A PI
//! Stepsize Control for the Numerical Solution of Ordinary Differential Equations (1988).

use fem_model::simulation::{Cause, Failure, History};

use super::Simulator;
use crate::integrators::Convergence;
use fem_elements::history::{put_option, take, take_option};
use fem_solvers::Real;

/// Part of the step that the last estimate would allow.
const SAFETY: f64 = 0.9;

/// Exponents of the controller for an error per unit of time that grows with the square of the step: of the last ratio and of the one
/// before, and after a rejection.
const EXPONENTS: [f64; 2] = [0.35, 0.2];
const REJECTED: f64 = 0.5;

/// Smallest and largest change of a step, and the growth up to which the step is kept, so that its matrix is kept too.
const CHANGES: [f64; 2] = [0.2, 2.0];
const STAYS: f64 = 1.15;

/// Smallest part of a time step that is tried.
const SMALLEST: f64 = 1e-6;

/// The change of a step that fails.
const FAILED: f64 = 0.25;

/// The control of the size of steps.
pub(super) struct Control {
    /// Largest estimated error of a time step's displacements, as a part of the body's length.
    tolerance: f64,
    /// Size of the next part, s; `None` before the first.
    dt: Option<f64>,
    /// Estimated error of the last accepted part over the allowed one.
    ratio: f64,
    /// Sum of the estimated errors of the parts of the last time step, m.
    pub(super) error: f64,
}

impl Control {
    /// Steps to a tolerance.
    pub(super) fn new(tolerance: f64) -> Self {
        Self { tolerance, dt: None, ratio: 1.0, error: 0.0 }
    }

    /// Starts again: the state is a new one.
    pub(super) fn forget(&mut self) {
        (self.dt, self.ratio, self.error) = (None, 1.0, 0.0);
    }

    /// Adds the size of the next part.
    pub(super) fn save(&self, history: &mut History) {
        put_option(history, "adaptive.dt", self.dt);
        history.put("adaptive.ratio", [self.ratio]);
    }

    /// Restores the size that [`save`](Self::save) has added.
    pub(super) fn restore(&mut self, history: &History) -> Result<(), String> {
        self.dt = take_option(history, "adaptive.dt")?;
        take(history, "adaptive.ratio", std::slice::from_mut(&mut self.ratio))
    }

    /// Takes an accepted part of h seconds into account. `is_cut` tells whether the end of the time step has cut it short.
    fn accept(&mut self, h: f64, ratio: f64, is_cut: bool) {
        // Without an error, as of a body at rest, the step grows.
        let ratio = ratio.max(1e-8);
        let change = SAFETY * ratio.powf(-EXPONENTS[0]) * self.ratio.powf(EXPONENTS[1]);
        let change = change.clamp(CHANGES[0], CHANGES[1]);
        let next = if (1.0..STAYS).contains(&change) { h } else { h * change };
        self.dt = Some(if is_cut { next.max(self.dt.unwrap_or(next)) } else { next });
        self.ratio = ratio;
    }

    /// Updates the step size after a rejected part.
    fn reject(&mut self, h: f64, ratio: f64) {
        self.dt = Some(h * (SAFETY * ratio.powf(-REJECTED)).clamp(CHANGES[0], SAFETY));
    }
}

impl<T: Real> Simulator<T> {
    /// Advances by one time step in parts.
    pub(super) fn adaptive_step(&mut self) -> Result<Convergence, Failure> {
        let (start, mut convergence) = (self.state.time, Convergence::Converged);
        let end = start + self.dt;
        if let Some(control) = &mut self.control {
            control.error = 0.0;
        }
        while self.state.time < end {
            let left = end - self.state.time;
            let wanted = self.control.as_ref().and_then(|control| control.dt).unwrap_or(self.dt);
            let parts = (left / wanted - 1e-9).ceil().max(1.0);
            self.substep_dt = left / parts;
            if self.part(wanted)? == Convergence::NotConverged {
                convergence = Convergence::NotConverged;
            }
            // A part that was rejected has become shorter.
            if self.substep_dt == left {
                self.state.time = end;
            }
        }
        Ok(convergence)
    }

    /// Advances by one part, of `substep_dt` or less.
    fn part(&mut self, wanted: f64) -> Result<Convergence, Failure> {
        let smallest = SMALLEST * self.dt;
        loop {
            let h = self.substep_dt;
            let outcome = self.try_substep();
            let ratio = self.error_ratio();
            let cause = match outcome {
                Ok(convergence) if ratio.is_none_or(|ratio| ratio <= 1.0) => {
                    let convergence = self.accept(convergence)?;
                    self.counters.accepted_steps += 1;
                    let error = self.integrator.estimated_error().unwrap_or_default();
                    if let (Some(control), Some(ratio)) = (&mut self.control, ratio) {
                        control.error += error;
                        control.accept(h, ratio, h < 0.999 * wanted);
                    }
                    return Ok(convergence);
                }
                Ok(_) => Cause::SmallestStep { dt: h, ratio: ratio.unwrap_or(f64::NAN) },
                Err(cause) => cause,
            };
            if h <= smallest {
                return Err(self.fail(cause));
            }
            self.state.copy_from(&self.last_good);
            self.counters.rejected_steps += 1;
            let Some(control) = &mut self.control else { return Err(self.fail(cause)) };
            match (cause, ratio) {
                (Cause::SmallestStep { ratio, .. }, _) if ratio.is_finite() => control.reject(h, ratio),
                _ => control.dt = Some(FAILED * h),
            }
            self.substep_dt = control.dt.unwrap_or(h).max(smallest).min(h);
        }
    }

    /// The estimated error of the last part over the allowed one.
    fn error_ratio(&self) -> Option<f64> {
        let control = self.control.as_ref()?;
        let allowed = control.tolerance * self.system.length * self.substep_dt / self.dt;
        Some(self.integrator.estimated_error()? / allowed)
    }
}
