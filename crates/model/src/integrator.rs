//! Time integration methods.

use serde::{Deserialize, Serialize};

use crate::ContactTreatment;

/// Time integration methods, as scene files and the command line spell them.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
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
    /// Bathe's method of two stages, second order: ends vibrations faster than the step, damps slow ones far less than `bdf2`.
    Bathe,
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

/// The kind of work in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Accelerations from forces alone; stable for short steps only.
    Explicit,
    /// Sweeps over constraints, elements or nodes, without a matrix.
    Sweeps,
    /// Rounds of local projections and one solve with a constant matrix.
    Rounds,
    /// One linear system of equations.
    Linearized,
    /// Newton's method.
    Newton,
    /// Newton's method without time: load steps.
    Equilibrium,
}

/// The properties of a method on which checks, switching, studies and pages rely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// The name in scene files.
    pub name: &'static str,
    /// The name in prose.
    pub label: &'static str,
    /// The kind of work in a step.
    pub family: Family,
    /// Order of convergence in the time step; `None` without time.
    pub order: Option<u32>,
    /// Largest stable ω dt of an undamped vibration; 0 if every step makes it grow, `None` if none does.
    pub stability_limit: Option<f64>,
    /// True if the method is symplectic: without damping its energy error stays bounded.
    pub is_symplectic: bool,
    /// Treatment of obstacles; `None` for a method that cannot keep a body outside.
    pub contact: Option<ContactTreatment>,
    /// True if forces are balanced at a moment within the step alone, and not at its end.
    pub is_balanced_within_step: bool,
}

/// Largest number of nodes for which an explicit method takes the consistent mass by default. Its linear systems need some thirty
/// products for each evaluation of the forces, a lumped mass one division.
pub const CONSISTENT_MASS: usize = 2000;

impl Integrator {
    /// All methods, with what is known about them.
    pub const FACTS: [(Self, Facts); 17] = {
        use std::f64::consts::SQRT_2;

        use ContactTreatment::{Barrier, Impulses, Projection};
        use Family::{Equilibrium, Explicit, Linearized, Newton, Rounds, Sweeps};
        const fn facts(
            name: &'static str,
            label: &'static str,
            family: Family,
            order: Option<u32>,
            is_symplectic: bool,
            contact: Option<ContactTreatment>,
        ) -> Facts {
            Facts {
                name,
                label,
                family,
                order,
                stability_limit: None,
                is_symplectic,
                contact,
                is_balanced_within_step: false,
            }
        }
        const fn balanced_within_step(facts: Facts) -> Facts {
            Facts { is_balanced_within_step: true, ..facts }
        }
        /// Hairer, Lubich and Wanner, Geometric Numerical Integration (2006), ch. I; Hairer and Wanner, Solving Ordinary Differential
        /// Equations II (1996), ch. IV.2.
        const fn stable_below(limit: f64, facts: Facts) -> Facts {
            Facts { stability_limit: Some(limit), ..facts }
        }
        [
            (
                Self::ExplicitEuler,
                stable_below(0.0, facts("explicit_euler", "explicit Euler", Explicit, Some(1), false, Some(Impulses))),
            ),
            (
                Self::SemiImplicitEuler,
                stable_below(
                    2.0,
                    facts("semi_implicit_euler", "semi-implicit Euler", Explicit, Some(1), true, Some(Impulses)),
                ),
            ),
            (Self::Rk2, stable_below(0.0, facts("rk2", "RK2", Explicit, Some(2), false, Some(Impulses)))),
            (Self::Rk4, stable_below(2.0 * SQRT_2, facts("rk4", "RK4", Explicit, Some(4), false, Some(Impulses)))),
            (Self::Verlet, stable_below(2.0, facts("verlet", "Verlet", Explicit, Some(2), true, Some(Impulses)))),
            (
                Self::LinearlyImplicitEuler,
                facts("linearly_implicit_euler", "linearly implicit Euler", Linearized, Some(1), false, None),
            ),
            (Self::ImplicitEuler, facts("implicit_euler", "implicit Euler", Newton, Some(1), false, Some(Barrier))),
            (
                Self::ImplicitMidpoint,
                balanced_within_step(facts(
                    "implicit_midpoint",
                    "implicit midpoint",
                    Newton,
                    Some(2),
                    true,
                    Some(Barrier),
                )),
            ),
            (Self::Newmark, facts("newmark", "Newmark", Newton, Some(2), false, Some(Barrier))),
            (
                Self::GeneralizedAlpha,
                balanced_within_step(facts(
                    "generalized_alpha",
                    "generalized-α",
                    Newton,
                    Some(2),
                    false,
                    Some(Barrier),
                )),
            ),
            (Self::Bdf2, facts("bdf2", "BDF2", Newton, Some(2), false, Some(Barrier))),
            (Self::Bathe, facts("bathe", "Bathe", Newton, Some(2), false, None)),
            (Self::Pbd, facts("pbd", "PBD", Sweeps, Some(1), false, Some(Projection))),
            (Self::Xpbd, facts("xpbd", "XPBD", Sweeps, Some(1), false, Some(Projection))),
            (Self::Vbd, facts("vbd", "VBD", Sweeps, Some(1), false, Some(Projection))),
            (
                Self::ProjectiveDynamics,
                facts("projective_dynamics", "projective dynamics", Rounds, Some(1), false, None),
            ),
            (Self::Static, facts("static", "static", Equilibrium, None, false, Some(Barrier))),
        ]
    };

    /// All methods.
    pub const ALL: [Self; Self::FACTS.len()] = {
        let mut all = [Self::Static; Self::FACTS.len()];
        let mut place = 0;
        while place < all.len() {
            all[place] = Self::FACTS[place].0;
            place += 1;
        }
        all
    };

    /// Its properties.
    pub fn facts(self) -> &'static Facts {
        // The table is in the order of the enum, as a test holds.
        &Self::FACTS[self as usize].1
    }

    /// The name as scene files spell it.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// The method of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|integrator| integrator.name() == name)
    }

    /// Returns true if a step computes accelerations from forces alone, and is stable for short steps only.
    pub fn is_explicit(self) -> bool {
        self.facts().family == Family::Explicit
    }

    /// Returns true if a step iterates over constraints, nodes or elements, and not over solutions of a linearized system:
    /// `[iterations]`.
    pub fn is_iterated(self) -> bool {
        matches!(self.facts().family, Family::Sweeps | Family::Rounds)
    }

    /// Returns true if a step needs the matrix of a linear system, beside the mass.
    pub fn has_matrix(self) -> bool {
        !matches!(self.facts().family, Family::Explicit | Family::Sweeps)
    }

    /// Returns true if a step needs a mass for each node, and so a lumped one.
    pub fn needs_node_masses(self) -> bool {
        self.facts().family == Family::Sweeps
    }

    /// Returns true if a step needs Newton's method.
    pub fn has_newton(self) -> bool {
        matches!(self.facts().family, Family::Newton | Family::Equilibrium)
    }

    /// Returns true if it is an implicit method of second order, whose steps estimate their error.
    pub fn estimates_error(self) -> bool {
        self.facts().family == Family::Newton && self.facts().order == Some(2)
    }

    /// The implicit methods of second order, whose steps estimate their error.
    pub fn second_order_implicit() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|integrator| integrator.estimates_error())
    }

    /// Returns true if the mass of a body with so many nodes is lumped by default.
    pub fn lumps_mass(self, nodes: usize, has_obstacles: bool) -> bool {
        self.needs_node_masses() || self.is_explicit() && (nodes > CONSISTENT_MASS || has_obstacles)
    }

    /// The methods that a running simulation of this one can be switched to, itself included: those of its family, and those that any
    /// time step suits.
    pub fn alternatives(self) -> Vec<Self> {
        let suits_any_step = |family| matches!(family, Family::Linearized | Family::Newton);
        let own = self.facts().family;
        let is_alternative = |other: &Self| match other.facts().family {
            Family::Equilibrium => own == Family::Equilibrium,
            family if own == Family::Equilibrium => family == own,
            family => family == own || suits_any_step(family) || own == Family::Sweeps && family == Family::Rounds,
        };
        // The family's own first.
        let mut all: Vec<Self> = Self::ALL.into_iter().filter(is_alternative).collect();
        all.sort_by_key(|other| match other.facts().family {
            family if family == own && !suits_any_step(own) => 0,
            Family::Rounds => 1,
            _ => 2,
        });
        all
    }

    /// The method that follows this one in a list, the first after the last.
    pub fn next_in(self, list: &[Self]) -> Self {
        let place = list.iter().position(|&integrator| integrator == self);
        list[place.map_or(0, |place| (place + 1) % list.len())]
    }
}
