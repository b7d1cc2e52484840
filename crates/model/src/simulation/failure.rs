//! Failures of a step.

use std::fmt;

use crate::Integrator;

/// A step that failed.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The step that failed, counted from 1 since the start or the last reset.
    pub step: usize,
    /// The time that the step would have reached, s.
    pub time: f64,
    /// The reason.
    pub cause: Cause,
    /// Advice to the user.
    pub remedy: String,
}

/// The reason of a failed step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// A position or velocity is NaN or infinite.
    NotFinite {
        /// The first such node.
        node: usize,
    },
    /// An element is inverted or has no volume left.
    Inverted {
        /// The element.
        element: usize,
        /// Its J = det F ≤ 0.
        J: f64,
    },
    /// A quadratic element is inverted at a corner, though at no quadrature point.
    InvertedAtCorner {
        /// The element.
        element: usize,
        /// J = det F ≤ 0 at that corner.
        J: f64,
    },
    /// A node lies behind an obstacle: a constrained one, which cannot give way.
    Penetrated {
        /// Number of the plane in `[[planes]]`.
        plane: usize,
        /// The deepest node.
        node: usize,
        /// m
        depth: f64,
    },
    /// The body has gained energy that nothing has supplied: a motion that grows without bound, or steps that are too long.
    EnergyGained {
        /// That energy, J.
        gained: f64,
        /// Largest energy that initial state, loads, prescribed motions and obstacles have supplied so far, J.
        turned_over: f64,
    },
    /// The estimated error of the smallest step that is tried is larger than the tolerance of `time.adaptive`.
    SmallestStep {
        /// That step, s.
        dt: f64,
        /// Its estimated error over the allowed one.
        ratio: f64,
    },
    /// At the start of a step, an energy or a force is too large for a number.
    Overflow,
    /// A linear system was not solved.
    Solver(Breakdown),
    /// Newton's method found no velocity of lower energy, though forces are not in balance.
    Stuck {
        /// The largest component of the residual, N.
        unbalanced: f64,
    },
    /// Forces are out of balance because of rounding errors alone, which are too large beside the loads.
    RoundOff {
        /// The largest component of the residual, N.
        unbalanced: f64,
    },
    /// The loads move a body without constraints, and no obstacle stops it.
    Adrift {
        /// Sum of the sizes of the forces that are not in balance, N.
        force: f64,
    },
}

impl Cause {
    /// Returns true if an element is inverted.
    pub fn is_inversion(&self) -> bool {
        matches!(self, Self::Inverted { .. } | Self::InvertedAtCorner { .. })
    }

    /// [`Cause::Inverted`] if the smallest J of all elements is not positive. `min_J` is as
    /// [`Simulation::min_J`](super::Simulation::min_J) returns it.
    pub fn inverted((J, element): (f64, usize)) -> Option<Self> {
        // NaN is no volume either.
        if J > 0.0 { None } else { Some(Self::Inverted { element, J }) }
    }
}

/// The reason why a linear system was not solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Breakdown {
    /// The matrix is not positive definite: a pivot, or the curvature along a search direction, is not positive.
    NotPositiveDefinite,
    /// The matrix is singular, or an entry is not finite.
    Singular,
    /// The iteration did not reach its tolerance.
    NotConverged {
        /// Relative residual that was reached.
        residual: f64,
    },
    /// The factor would not fit into memory.
    TooLarge,
    /// An array of the matrix does not fit into the memory of the graphics device.
    DeviceTooSmall,
    /// The graphics device was lost, ran out of memory, or refused a command.
    DeviceFailed,
}

/// The remedy for rounding errors of single precision.
const IN_DOUBLE: &str = "time.precision = \"f64\" in place of \"f32\"";

impl Failure {
    /// The failure of the step that follows the state at `time` (s) after `steps` steps of length `dt` (s).
    pub fn of_step(steps: usize, time: f64, dt: f64, integrator: Integrator, cause: Cause) -> Self {
        let half = format!("{:.2e}", 0.5 * dt);
        let remedy = match integrator {
            _ if matches!(cause, Cause::SmallestStep { .. }) => {
                "give a larger time.adaptive.tolerance, or loads without jumps".to_owned()
            }
            _ if matches!(cause, Cause::InvertedAtCorner { .. }) => {
                "use a finer mesh there, smaller loads, or mesh.order = 1, whose elements cannot be inverted in part"
                    .to_owned()
            }
            _ if matches!(cause, Cause::Solver(breakdown) if breakdown.is_of_machine()) => {
                "use solver.kind = \"pcg\"".to_owned()
            }
            Integrator::Static if matches!(cause, Cause::Adrift { .. }) => {
                "constrain the motion along that force by [fixed] or [[prescribed]], or add an obstacle by [[planes]]"
                    .to_owned()
            }
            Integrator::Static if matches!(cause, Cause::RoundOff { .. }) => {
                format!("use {IN_DOUBLE}, or elements and moduli that differ less")
            }
            Integrator::Static if matches!(cause, Cause::Solver(Breakdown::NotConverged { .. })) => {
                format!("use solver.kind = \"cholesky\", or {IN_DOUBLE}")
            }
            Integrator::Static if matches!(cause, Cause::Solver(_)) => format!(
                "constrain the body so that it cannot move freely, use {IN_DOUBLE}, or, under a nonlinear law, more static.load_steps or smaller loads"
            ),
            Integrator::Static => format!(
                "use more static.load_steps, smaller loads, {IN_DOUBLE}, or static.arc_length where the load has a limit point"
            ),
            Integrator::ImplicitEuler => {
                format!("use a time step of {half} s or less, smaller loads, or a gentler pull")
            }
            _ if integrator.is_iterated() => {
                format!("use a time step of {half} s or less, more iterations.count, or implicit_euler")
            }
            _ if integrator.has_newton() => {
                format!("use a time step of {half} s or less, a gentler pull, or implicit_euler")
            }
            _ => format!("use a time step of {half} s or less, or implicit_euler"),
        };
        Self { step: steps + 1, time: time + dt, cause, remedy }
    }

    /// The same failure of an explicit method, with its critical time step (s) in the remedy; zero if there is no stable time step, and `None`
    /// of any other method. An element that is inverted at a corner needs another mesh, not another step.
    pub fn with_critical_time_step(mut self, critical: Option<f64>) -> Self {
        let Some(critical) = critical.filter(|_| !matches!(self.cause, Cause::InvertedAtCorner { .. })) else {
            return self;
        };
        self.remedy = if critical == 0.0 {
            "without damping the method is unstable at any time step; use verlet, or implicit_euler".to_owned()
        } else {
            format!(
                "the critical time step of the undeformed body is about {critical:.3e} s; use a time step well below \
                 that, more time.substeps, or implicit_euler"
            )
        };
        self
    }
}

impl Breakdown {
    /// Returns true if memory or a device is at fault, so that no other matrix would help.
    pub fn is_of_machine(self) -> bool {
        matches!(self, Self::TooLarge | Self::DeviceTooSmall | Self::DeviceFailed)
    }
}

impl fmt::Display for Breakdown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositiveDefinite => write!(f, "the stiffness is not positive definite"),
            Self::Singular => write!(f, "the stiffness is singular, or not finite"),
            Self::NotConverged { residual } => {
                write!(f, "the linear solver does not converge (relative residual {residual:.1e})")
            }
            Self::TooLarge => write!(f, "the factor of the stiffness does not fit into memory"),
            Self::DeviceTooSmall => {
                write!(f, "the stiffness does not fit into the graphics device")
            }
            Self::DeviceFailed => {
                write!(f, "the graphics device was lost, or is out of memory")
            }
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the simulation failed in step {} (t = {:.6} s): ", self.step, self.time)?;
        match self.cause {
            Cause::NotFinite { node } => write!(f, "the position or velocity of node {node} is no longer finite")?,
            Cause::Inverted { element, J } => write!(f, "element {element} is inverted (J = {J:.3e})")?,
            Cause::InvertedAtCorner { element, J } => {
                write!(f, "the quadratic element {element} is inverted at a corner (J = {J:.3e})")?;
            }
            Cause::Penetrated { plane, node, depth } => {
                write!(f, "node {node} is constrained, and lies {depth:.3e} m behind planes[{plane}]")?;
            }
            Cause::EnergyGained { gained, turned_over } => write!(
                f,
                "the body has gained {gained:.3e} J from nothing, and initial state, loads, prescribed motions and planes have supplied \
                 {turned_over:.3e} J"
            )?,
            Cause::SmallestStep { dt, ratio } => write!(
                f,
                "the error of the smallest step, {dt:.3e} s, is estimated at {ratio:.1e} times what time.adaptive allows"
            )?,
            Cause::Overflow => write!(f, "an energy or a force is too large for a number")?,
            Cause::Solver(breakdown) => write!(f, "{breakdown}")?,
            Cause::Adrift { force } => write!(
                f,
                "the body has no equilibrium: it moves on as a whole under {force:.3e} N that neither constraints nor obstacles bear"
            )?,
            Cause::Stuck { unbalanced } => write!(
                f,
                "Newton's method finds no way to lower the energy, and {unbalanced:.3e} N are not in balance"
            )?,
            Cause::RoundOff { unbalanced } => {
                write!(f, "rounding errors leave {unbalanced:.3e} N out of balance")?;
            }
        }
        write!(f, "; {}", self.remedy)?;
        match self.cause {
            Cause::EnergyGained { .. } => write!(f, "; energy.accept_gain = true accepts the gain"),
            _ => Ok(()),
        }
    }
}

impl std::error::Error for Failure {}
