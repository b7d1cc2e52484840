//! Bathe's method of two stages, Bathe, Baig, On a Composite Implicit Time Integration Procedure for Nonlinear Dynamics (2005); Bathe, Conserving
//! Energy and Momentum in Nonlinear Dynamics (2007): the trapezoidal rule for the part γ = 2 − √2 of a step, then the backward formula through
//! its start, that stage and its end. Second order; vibrations faster than the step end at once, ρ∞ = 0, as with BDF2, and slow ones lose a
//! seventieth of what they lose there.
//!
//! With this γ both stages have the same matrix M + τ² K, τ = γ dt/2. The method keeps the acceleration at the end of a step alone. It has no
//! contact: obstacles would act at the stage as well, and with the forces at the end of a step alone a body gains energy.

use std::f64::consts::SQRT_2;

use fem_model::NewmarkParameters;
use fem_model::simulation::{Cause, Counters};

use super::coefficients::Coefficients;
use super::{SecondOrder, bdf2, newmark};
use crate::forces::Moment;
use crate::integrators::Convergence;
use crate::model::state::State;
use crate::model::system::System;
use fem_solvers::Real;

/// Part of a step before its stage, γ.
const STAGE: f64 = 2.0 - SQRT_2;

/// From the start to the stage.
fn first_stage(dt: f64) -> Coefficients {
    newmark::coefficients(NewmarkParameters { beta: 0.25, gamma: 0.5 }, STAGE * dt)
}

/// From the stage to the end.
fn second_stage(dt: f64) -> Coefficients {
    let of = bdf2::coefficients((1.0 - STAGE) * dt, (1.0 - STAGE) / STAGE);
    let tau = first_stage(dt).tau;
    Coefficients { tau, of_velocity: tau, acceleration: [0.0, 1.0], ..of }
}

impl<T: Real> SecondOrder<T> {
    /// A step of Bathe's method. The state for this step stays, since the step may be repeated.
    pub(super) fn two_stages(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let (time, part) = (state.time, STAGE * dt);
        let (stage, end) = (Moment::at(time + part), Moment::at(time + dt));
        let first = self.advance(system, state, (part, stage), &first_stage(dt), counters)?;
        std::mem::swap(&mut self.known, &mut self.middle);
        std::mem::swap(&mut self.known, &mut self.next);
        state.time = time + part;
        let second = self.advance(system, state, (dt - part, end), &second_stage(dt), counters);
        state.time = time;
        std::mem::swap(&mut self.known, &mut self.middle);
        Ok(if second? == Convergence::Converged { first } else { Convergence::NotConverged })
    }
}
