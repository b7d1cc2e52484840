//! The implicit midpoint rule: M (v₁ − v₀)/dt = f((u₀ + u₁)/2, (v₀ + v₁)/2), forces at the middle of the step. Second order; symplectic;
//! keeps the angular momentum of a free body. Vibrations faster than the step keep their amplitude, ρ∞ = 1.

use super::coefficients::{Coefficients, Combination};

/// Implicit Euler to the middle of the step, and as far again.
pub fn coefficients(dt: f64) -> Coefficients {
    let half = 0.5 * dt;
    Coefficients {
        tau: half,
        stage: 0.5,
        inertial: Combination { velocity: half, ..Combination::default() },
        velocity: Combination { velocity: 1.0, ..Combination::default() },
        of_velocity: dt,
        acceleration: [0.0; 2],
        obstacles: 1.0,
        beyond: 0.0,
    }
}
