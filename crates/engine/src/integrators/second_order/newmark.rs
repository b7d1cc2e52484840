//! Newmark, A Method of Computation for Structural Dynamics (1959): u₁ = u₀ + dt v₀ + dt² ((½ − β) a₀ + β a₁),
//! v₁ = v₀ + dt ((1 − γ) a₀ + γ a₁), forces at the end of the step. Second order for γ = ½; β = ¼ is the trapezoidal rule, ρ∞ = 1.
//!
//! Forces of obstacles act with γ a₁ alone and are not part of a₀: Kane, Repetto, Ortiz, Marsden, Finite Element Analysis of Nonsmooth
//! Contact (1999). Their part of u₁ is at least dt²/2 a₁, that of v₁ dt a₁, whatever β and γ. So contact is stable where the elements are
//! only up to a critical time step, which knows nothing of a barrier's stiffness.

use fem_model::NewmarkParameters;

use super::coefficients::{Coefficients, Combination};

/// Newmark's step with these parameters.
pub fn coefficients(NewmarkParameters { beta, gamma }: NewmarkParameters, dt: f64) -> Coefficients {
    let obstacles = f64::max(1.0 / gamma, 0.5 / beta);
    Coefficients {
        tau: dt * beta.sqrt(),
        stage: 1.0,
        inertial: Combination { velocity: dt, acceleration: (0.5 - beta) * dt * dt, ..Combination::default() },
        velocity: Combination { velocity: 1.0, acceleration: (1.0 - gamma) * dt, ..Combination::default() },
        of_velocity: gamma * dt,
        acceleration: [0.0, 1.0],
        obstacles,
        beyond: if beta < 0.5 * gamma { gamma * dt * obstacles - dt } else { 0.0 },
    }
}
