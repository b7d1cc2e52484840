//! The methods of this family.

use fem_model::{Integrator, Method, NewmarkParameters};

use super::coefficients::Coefficients;
use super::{bdf2, generalized_alpha, implicit_midpoint, newmark};

/// A method of this family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scheme {
    /// The implicit midpoint rule.
    ImplicitMidpoint,
    /// Newmark's method.
    Newmark(NewmarkParameters),
    /// The generalized-α method with its spectral radius ρ∞.
    GeneralizedAlpha(f64),
    /// The backward differentiation formula.
    Bdf2,
}

impl Scheme {
    /// The method that a scene names; `None` if it belongs to another family.
    pub fn new(kind: Integrator, method: &Method) -> Option<Self> {
        match kind {
            Integrator::ImplicitMidpoint => Some(Self::ImplicitMidpoint),
            Integrator::Newmark => Some(Self::Newmark(method.newmark)),
            Integrator::GeneralizedAlpha => Some(Self::GeneralizedAlpha(method.rho_inf)),
            Integrator::Bdf2 => Some(Self::Bdf2),
            _ => None,
        }
    }

    /// Coefficients of a step of `dt` seconds after one of `before` seconds; `None` for a first step that has
    /// two stages.
    pub(super) fn coefficients(self, dt: f64, before: Option<f64>) -> Option<Coefficients> {
        match self {
            Self::ImplicitMidpoint => Some(implicit_midpoint::coefficients(dt)),
            Self::Newmark(parameters) => Some(newmark::coefficients(parameters, dt)),
            Self::GeneralizedAlpha(rho_inf) => Some(generalized_alpha::coefficients(rho_inf, dt)),
            Self::Bdf2 => before.map(|before| bdf2::coefficients(dt, dt / before)),
        }
    }

    /// (1 − γ/2β)²: from an initial acceleration a₀ of vibrations faster than the step, the velocity 1 − γ/2β times dt a₀ remains. Zero for
    /// methods without that, and for those that are not stable at such steps.
    pub(super) fn overshoot(self) -> f64 {
        let parameters = match self {
            Self::Newmark(parameters) if parameters.is_unconditionally_stable() => parameters,
            Self::GeneralizedAlpha(rho_inf) => generalized_alpha::parameters(rho_inf),
            _ => return 0.0,
        };
        (1.0 - parameters.gamma / (2.0 * parameters.beta)).powi(2)
    }

    pub(super) fn has_acceleration(self) -> bool {
        matches!(self, Self::Newmark(_) | Self::GeneralizedAlpha(_))
    }
}
