//! The names of time integration methods.

use serde::Deserialize;

/// Time integration methods, as scene files and the command line spell them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)] // the names are the field's
pub enum Integrator {
    ExplicitEuler,
    SemiImplicitEuler,
    Rk2,
    Rk4,
    Verlet,
    LinearlyImplicitEuler,
    ImplicitEuler,
    ImplicitMidpoint,
    Newmark,
    GeneralizedAlpha,
    Bdf2,
    Static,
}

impl Integrator {
    /// All methods.
    pub const ALL: [Self; 12] = [
        Self::ExplicitEuler,
        Self::SemiImplicitEuler,
        Self::Rk2,
        Self::Rk4,
        Self::Verlet,
        Self::LinearlyImplicitEuler,
        Self::ImplicitEuler,
        Self::ImplicitMidpoint,
        Self::Newmark,
        Self::GeneralizedAlpha,
        Self::Bdf2,
        Self::Static,
    ];

    /// The implicit methods of second order in time.
    pub const SECOND_ORDER_IMPLICIT: [Self; 4] =
        [Self::ImplicitMidpoint, Self::Newmark, Self::GeneralizedAlpha, Self::Bdf2];

    /// The name as scene files spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::ExplicitEuler => "explicit_euler",
            Self::SemiImplicitEuler => "semi_implicit_euler",
            Self::Rk2 => "rk2",
            Self::Rk4 => "rk4",
            Self::Verlet => "verlet",
            Self::LinearlyImplicitEuler => "linearly_implicit_euler",
            Self::ImplicitEuler => "implicit_euler",
            Self::ImplicitMidpoint => "implicit_midpoint",
            Self::Newmark => "newmark",
            Self::GeneralizedAlpha => "generalized_alpha",
            Self::Bdf2 => "bdf2",
            Self::Static => "static",
        }
    }

    /// Whether a step needs forces alone, and no matrix beside the mass.
    pub fn is_explicit(self) -> bool {
        match self {
            Self::ExplicitEuler | Self::SemiImplicitEuler | Self::Rk2 | Self::Rk4 | Self::Verlet => true,
            Self::LinearlyImplicitEuler | Self::ImplicitEuler | Self::Static => false,
            Self::ImplicitMidpoint | Self::Newmark | Self::GeneralizedAlpha | Self::Bdf2 => false,
        }
    }

    /// Whether a step needs Newton's method.
    pub fn has_newton(self) -> bool {
        !self.is_explicit() && self != Self::LinearlyImplicitEuler
    }

    /// Whether a step can keep a body outside an obstacle.
    pub fn supports_contact(self) -> bool {
        match self {
            Self::ExplicitEuler | Self::SemiImplicitEuler | Self::Rk2 | Self::Rk4 | Self::Verlet => true,
            Self::ImplicitEuler | Self::Static => true,
            Self::ImplicitMidpoint | Self::Newmark | Self::GeneralizedAlpha | Self::Bdf2 => true,
            Self::LinearlyImplicitEuler => false,
        }
    }

    /// The method that follows this one in a list, the first after the last.
    pub fn next_in(self, list: &[Self]) -> Self {
        let place = list.iter().position(|&integrator| integrator == self);
        list[place.map_or(0, |place| (place + 1) % list.len())]
    }

    /// The method of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|integrator| integrator.name() == name)
    }
}
