//! Chung, Hulbert, A Time Integration Algorithm for Structural Dynamics with Improved Numerical Dissipation: the Generalized-α Method
//! (1993): Newmark's formulas with M ((1 − α_m) a₁ + α_m a₀) = f((1 − α_f) u₁ + α_f u₀, …). Second order; vibrations faster than the step
//! lose all but the part ρ∞ of their amplitude in each step.

use fem_model::NewmarkParameters;

use super::coefficients::{Coefficients, Combination};

/// α_m and α_f for a spectral radius ρ∞.
fn alphas(rho_inf: f64) -> [f64; 2] {
    [(2.0 * rho_inf - 1.0) / (rho_inf + 1.0), rho_inf / (rho_inf + 1.0)]
}

/// β and γ for this spectral radius.
pub fn parameters(rho_inf: f64) -> NewmarkParameters {
    let [alpha_m, alpha_f] = alphas(rho_inf);
    NewmarkParameters { beta: 0.25 * (1.0 - alpha_m + alpha_f).powi(2), gamma: 0.5 - alpha_m + alpha_f }
}

/// The step with this spectral radius ρ∞.
pub fn coefficients(rho_inf: f64, dt: f64) -> Coefficients {
    let [alpha_m, alpha_f] = alphas(rho_inf);
    let NewmarkParameters { beta, gamma } = parameters(rho_inf);
    let (stage, of_end) = (1.0 - alpha_f, 1.0 - alpha_m);
    // a₁ = (a_s − α_m a₀)/(1 − α_m), and z = θ (dt v₀ + dt² (½ − β) a₀ + β dt² a₁).
    let square = stage * beta * dt * dt / of_end;
    let kept = -alpha_m / of_end;
    Coefficients {
        tau: square.sqrt(),
        stage,
        inertial: Combination {
            velocity: stage * dt,
            acceleration: stage * dt * dt * (0.5 - beta) - square * alpha_m,
            ..Combination::default()
        },
        velocity: Combination {
            velocity: 1.0,
            acceleration: dt * (1.0 - gamma + gamma * kept),
            ..Combination::default()
        },
        of_velocity: gamma * dt / of_end,
        acceleration: [kept, 1.0 / of_end],
        obstacles: of_end / gamma,
        beyond: 0.0,
    }
}
