//! The methods of this family.

use fem_scene::{Integrator, Method, NewmarkParameters};

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

    pub(super) fn has_acceleration(self) -> bool {
        matches!(self, Self::Newmark(_) | Self::GeneralizedAlpha(_))
    }
}
