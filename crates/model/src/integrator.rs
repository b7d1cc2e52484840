//! Time integration methods.

use serde::Deserialize;

/// Time integration methods, as scene files and the command line spell them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Explicit Euler, first order. Motions grow without damping at any step.
    ExplicitEuler,
    /// Semi-implicit Euler: explicit, symplectic, first order.
    SemiImplicitEuler,
    /// Explicit midpoint rule, second order. Motions grow slowly.
    Rk2,
    /// Classical Runge–Kutta method: explicit, fourth order.
    Rk4,
    /// Verlet: explicit, symplectic, second order.
    Verlet,
    /// Implicit Euler, linearized: one linear solve per step, first order.
    LinearlyImplicitEuler,
    /// Implicit Euler with Newton's method, first order. Stable at any step.
    ImplicitEuler,
    /// Implicit midpoint rule: symplectic, second order.
    ImplicitMidpoint,
    /// Newmark's method, second order; by default the trapezoidal rule.
    Newmark,
    /// Generalized-α method, second order: damps vibrations faster than the step.
    GeneralizedAlpha,
    /// Backward differentiation formula of two steps, second order: ends vibrations faster than the step.
    Bdf2,
    /// Position-based dynamics: lengths of edges and volumes of elements, without moduli; first order.
    Pbd,
    /// Extended position-based dynamics, first order; sweeps over the elements converge to `implicit_euler`.
    Xpbd,
    /// Vertex block descent, first order; sweeps over the nodes converge to `implicit_euler`.
    Vbd,
    /// Projective dynamics, first order; local–global rounds converge to `implicit_euler`.
    ProjectiveDynamics,
    /// Equilibrium by load steps.
    Static,
}

/// Largest number of nodes for which an explicit method takes the consistent mass by default. Its linear systems need some thirty
/// products for each evaluation of the forces, a lumped mass one division.
pub const CONSISTENT_MASS: usize = 2000;

impl Integrator {
    /// All methods.
    pub const ALL: [Self; 16] = [
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
        Self::Pbd,
        Self::Xpbd,
        Self::Vbd,
        Self::ProjectiveDynamics,
        Self::Static,
    ];

    /// The implicit methods of second order in time.
    pub const SECOND_ORDER_IMPLICIT: [Self; 4] =
        [Self::ImplicitMidpoint, Self::Newmark, Self::GeneralizedAlpha, Self::Bdf2];

    /// The methods that iterate over constraints, nodes or elements, and not over solutions of a linearized system: `[iterations]`.
    pub const ITERATED: [Self; 4] = [Self::Pbd, Self::Xpbd, Self::Vbd, Self::ProjectiveDynamics];

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
            Self::Pbd => "pbd",
            Self::Xpbd => "xpbd",
            Self::Vbd => "vbd",
            Self::ProjectiveDynamics => "projective_dynamics",
            Self::Static => "static",
        }
    }

    /// Returns true if a step computes accelerations from forces alone, and is stable for short steps only.
    pub fn is_explicit(self) -> bool {
        match self {
            Self::ExplicitEuler | Self::SemiImplicitEuler | Self::Rk2 | Self::Rk4 | Self::Verlet => true,
            Self::LinearlyImplicitEuler | Self::ImplicitEuler | Self::Static => false,
            Self::ImplicitMidpoint | Self::Newmark | Self::GeneralizedAlpha | Self::Bdf2 => false,
            Self::Pbd | Self::Xpbd | Self::Vbd | Self::ProjectiveDynamics => false,
        }
    }

    /// Returns true if it is one of [`ITERATED`](Self::ITERATED).
    pub fn is_iterated(self) -> bool {
        Self::ITERATED.contains(&self)
    }

    /// Returns true if a step needs the matrix of a linear system, beside the mass.
    pub fn has_matrix(self) -> bool {
        !self.is_explicit() && !self.needs_node_masses()
    }

    /// Returns true if a step needs a mass for each node, and so a lumped one.
    pub fn needs_node_masses(self) -> bool {
        matches!(self, Self::Pbd | Self::Xpbd | Self::Vbd)
    }

    /// Returns true if the mass of a body with so many nodes is lumped by default.
    pub fn lumps_mass(self, nodes: usize, has_obstacles: bool) -> bool {
        self.needs_node_masses() || self.is_explicit() && (nodes > CONSISTENT_MASS || has_obstacles)
    }

    /// Returns true if a step needs Newton's method.
    pub fn has_newton(self) -> bool {
        !self.is_explicit() && self != Self::LinearlyImplicitEuler && !self.is_iterated()
    }

    /// Returns true if obstacles stop nodes one by one as its iterations go on, without a barrier.
    pub fn projects_contact(self) -> bool {
        self.needs_node_masses()
    }

    /// Returns true if a step can keep a body outside an obstacle.
    pub fn supports_contact(self) -> bool {
        match self {
            Self::ExplicitEuler | Self::SemiImplicitEuler | Self::Rk2 | Self::Rk4 | Self::Verlet => true,
            Self::ImplicitEuler | Self::Static => true,
            Self::ImplicitMidpoint | Self::Newmark | Self::GeneralizedAlpha | Self::Bdf2 => true,
            Self::Pbd | Self::Xpbd | Self::Vbd => true,
            Self::LinearlyImplicitEuler | Self::ProjectiveDynamics => false,
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
