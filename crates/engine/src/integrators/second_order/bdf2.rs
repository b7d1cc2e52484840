//! The backward differentiation formula of second order, Curtiss, Hirschfelder, Integration of Stiff Equations (1952), for steps of any
//! length: y₁ − (1 + q) y₀ + q y₋₁ = τ ẏ₁ with the ratio r of a step to the one before, q = r²/(1 + 2r) and τ = dt (1 + r)/(1 + 2r).
//! Forces are those at the end of the step. Vibrations faster than the step end at once, ρ∞ = 0.
//!
//! Forces of obstacles add dt a to v₁ and to v₋₁, τ dt a to u₁: no later step goes on with their impulse, a node that a plane hits leaves with dt/τ = 3/2 of its
//! velocity, and a body at rest has none. With τ a and the formula's memory it would leave with 9/4 of it, which is energy from nothing.
//!
//! The first step is one of the diagonally implicit Runge–Kutta method of second order with ρ∞ = 0, Alexander (1977): its two stages
//! have the same form.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use super::coefficients::{Coefficients, Combination};

/// Part of the first step before its first stage, γ = 1 − 1/√2.
pub const FIRST_STAGE: f64 = 1.0 - FRAC_1_SQRT_2;

/// A step after one, to which it has this ratio.
pub fn coefficients(dt: f64, ratio: f64) -> Coefficients {
    let tau = dt * (1.0 + ratio) / (1.0 + 2.0 * ratio);
    Coefficients { obstacles: dt / tau, ..of(tau, ratio * ratio / (1.0 + 2.0 * ratio)) }
}

/// The first stage of the first step.
pub fn first_stage(dt: f64) -> Coefficients {
    implicit_euler(FIRST_STAGE * dt)
}

/// A step of implicit Euler.
pub fn implicit_euler(dt: f64) -> Coefficients {
    of(dt, 0.0)
}

/// Its second one, from the first: y₁ = y₀ + (1 − γ) dt f(y_γ) + γ dt f(y₁), with (y_γ − y₀)/(γ dt) in place of f(y_γ).
pub fn second_stage(dt: f64) -> Coefficients {
    of(FIRST_STAGE * dt, SQRT_2)
}

/// v₁ = (u₁ − u₀ − q p)/τ with the last increment p, and a₁ = (v₁ − v₀ − q (v₀ − v₋₁))/τ.
fn of(tau: f64, q: f64) -> Coefficients {
    Coefficients {
        tau,
        stage: 1.0,
        inertial: Combination {
            velocity: tau * (1.0 + q),
            earlier_velocity: -tau * q,
            increment: q,
            ..Combination::default()
        },
        velocity: Combination { velocity: 1.0 + q, earlier_velocity: -q, ..Combination::default() },
        of_velocity: tau,
        acceleration: [0.0; 2],
        obstacles: 1.0,
        beyond: 0.0,
    }
}
