//! Bathe's method of two stages, Bathe, Baig, On a Composite Implicit Time Integration Procedure for Nonlinear Dynamics (2005); Bathe, Conserving
//! Energy and Momentum in Nonlinear Dynamics (2007): the trapezoidal rule for the part γ = 2 − √2 of a step, then the backward formula through
//! its start, that stage and its end. Second order; vibrations faster than the step end at once, ρ∞ = 0, as with BDF2, and slow ones lose a
//! seventieth of what they lose there.
//!
//! With this γ both stages have the same matrix M + τ² K, τ = γ dt/2. The method keeps the acceleration at the end of a step alone. It has no
//! contact: obstacles would act at the stage as well, and with the forces at the end of a step alone a body gains energy.

use std::f64::consts::SQRT_2;

use fem_model::NewmarkParameters;

use super::coefficients::Coefficients;
use super::{bdf2, newmark};

/// Part of a step before its stage, γ.
pub const STAGE: f64 = 2.0 - SQRT_2;

/// From the start to the stage.
pub fn first_stage(dt: f64) -> Coefficients {
    newmark::coefficients(NewmarkParameters { beta: 0.25, gamma: 0.5 }, STAGE * dt)
}

/// From the stage to the end.
pub fn second_stage(dt: f64) -> Coefficients {
    let of = bdf2::coefficients((1.0 - STAGE) * dt, (1.0 - STAGE) / STAGE);
    let tau = first_stage(dt).tau;
    Coefficients { tau, of_velocity: tau, acceleration: [0.0, 1.0], ..of }
}
