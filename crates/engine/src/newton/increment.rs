//! The increment of a step, with its inertia, its damping and its end.

use crate::forces::Moment;
use crate::model::damping::DampingRates;
use crate::model::system::System;
use fem_elements::vector::{axpy, scale};
use fem_solvers::Real;

/// The start and the end of a step.
#[derive(Clone, Copy)]
pub struct Increment<'a, T> {
    /// Displacements at its start, m.
    pub start: &'a [[T; 3]],
    /// The end of the increment, at which forces are evaluated.
    pub end: Moment,
    /// Inertia and damping; `None` for equilibrium.
    pub inertia: Option<Inertia<'a, T>>,
}

/// Inertia and damping of a step.
#[derive(Clone, Copy)]
pub struct Inertia<'a, T> {
    /// ŵ, the increment without forces, m; dt v₀ in implicit Euler.
    pub inertial: &'a [[T; 3]],
    /// 1/τ², 1/s².
    pub over_dt2: T,
    /// c α, 1/s², c β, and c of the damping matrices of forces, 1/s; `None` without damping.
    pub damping: Option<DampingRates<T>>,
    /// w̌, the increment without a velocity at its end, m; `None` for zero.
    pub still: Option<&'a [[T; 3]]>,
    /// Displacements at which damping takes its matrices, m; `None` for those at the start.
    pub stiffness_at: Option<&'a [[T; 3]]>,
    /// The end of the step; `None` if the increment already ends there, and not at a stage.
    pub step_end: Option<StepEnd>,
}

/// The end of a step whose increment w ends at a stage within the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepEnd {
    /// The moment, at which obstacles are evaluated, and prescribed motions where `ratio` is not 1.
    pub moment: Moment,
    /// s: s w is the increment of the whole step.
    pub ratio: f64,
    /// κ: multiple of the forces of obstacles in the equation of the stage.
    pub weight: f64,
}

impl<'a, T: Real> Inertia<'a, T> {
    /// Inertia of a step of implicit Euler of `dt` seconds.
    pub fn new(system: &System<T>, inertial: &'a [[T; 3]], dt: f64) -> Self {
        Self::of_stage(system, inertial, dt, 1.0)
    }

    /// Inertia of a stage with this τ (s) and this c τ.
    pub fn of_stage(system: &System<T>, inertial: &'a [[T; 3]], tau: f64, velocity: f64) -> Self {
        let rates = || DampingRates::new(system.damping.as_ref(), velocity / tau);
        Self {
            inertial,
            over_dt2: T::of(1.0 / (tau * tau)),
            damping: system.is_damped().then(rates),
            still: None,
            stiffness_at: None,
            step_end: None,
        }
    }
}

impl<T: Real> Inertia<'_, T> {
    /// w − w̌, written into `difference` where it is not w.
    pub(super) fn moved<'b>(&self, w: &'b [[T; 3]], difference: &'b mut [[T; 3]]) -> &'b [[T; 3]] {
        let Some(still) = self.still else { return w };
        difference.copy_from_slice(w);
        axpy(-1.0, still, difference);
        difference
    }
}

impl<T: Real> Increment<'_, T> {
    /// The end of the step where that is not the end of the increment.
    pub fn step_end(&self) -> Option<StepEnd> {
        self.inertia.and_then(|inertia| inertia.step_end)
    }

    /// Overwrites the constrained entries of an increment: the prescribed part of the step's.
    pub fn prescribe(&self, system: &System<T>, w: &mut [[T; 3]]) {
        match self.step_end().filter(|step_end| step_end.ratio != 1.0) {
            None => system.prescribe(self.start, self.end, w),
            Some(StepEnd { moment, ratio, .. }) => {
                system.prescribe(self.start, moment, w);
                system.dirichlet.scale_constrained(1.0 / ratio, w);
            }
        }
    }

    /// Changes an increment, an initial guess, where the end of the step would be infeasible.
    pub fn make_feasible(&self, system: &System<T>, w: &mut [[T; 3]]) {
        let Some(StepEnd { moment, ratio, .. }) = self.step_end() else {
            return system.make_feasible(self.start, self.end, w);
        };
        if system.forces.has_obstacles() {
            scale(ratio, w);
            system.make_feasible(self.start, moment, w);
            scale(1.0 / ratio, w);
            self.prescribe(system, w);
        }
    }
}
