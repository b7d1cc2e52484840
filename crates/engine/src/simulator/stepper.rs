//! The integrators behind one enum.

use std::sync::Arc;

use crate::forces::pulls::{AnchorSpring, Pulls};
use crate::integrators::{
    ExplicitEuler, ImplicitEuler, LinearlyImplicitEuler, Rk2, Rk4, SemiImplicitEuler, Statics, Verlet,
};
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::{Limits, Newton};
use crate::number::Real;
use crate::solvers::{Solver, SolverChoice};
use fem_scene::simulation::{Cause, Counters};
use fem_scene::{Integrator, Method};

/// Relative residuals that a linear solver always reaches, in roundings.
const ROUNDINGS: f64 = 8.0;

/// The coarsest solve that still makes a direction of Newton's method.
const COARSEST: f64 = 0.05;

/// An integrator with all that it keeps from step to step.
pub(super) enum Stepper<T: Real> {
    ExplicitEuler(ExplicitEuler<T>),
    SemiImplicitEuler(SemiImplicitEuler<T>),
    Rk2(Rk2<T>),
    Rk4(Rk4<T>),
    Verlet(Verlet<T>),
    LinearlyImplicitEuler(LinearlyImplicitEuler<T>),
    ImplicitEuler(ImplicitEuler<T>),
    Static(Statics<T>),
}

impl<T: Real> Stepper<T> {
    /// What the integrator needs, and nothing else.
    pub(super) fn new(method: &Method, system: &System<T>, integrator: Integrator, choice: SolverChoice) -> Self {
        let solver = || {
            let rest: Vec<[f64; 3]> = system.rest[..system.free()].iter().map(|x| (*x).into()).collect();
            Solver::new(choice, &Arc::clone(&system.pattern), &rest)
        };
        let tolerance = method.solver.as_ref().and_then(|solver| solver.tolerance).unwrap_or(1e-12);
        // No residual is below round-off, whatever the scene asks for.
        let tolerance = tolerance.max(ROUNDINGS * T::EPSILON.as_f64());
        let newton =
            || Newton::new(limits(method, integrator, tolerance), solver(), system.nodes(), system.pattern.blocks());
        match integrator {
            Integrator::ExplicitEuler => Self::ExplicitEuler(ExplicitEuler::new(system)),
            Integrator::SemiImplicitEuler => Self::SemiImplicitEuler(SemiImplicitEuler::new(system)),
            Integrator::Rk2 => Self::Rk2(Rk2::new(system)),
            Integrator::Rk4 => Self::Rk4(Rk4::new(system)),
            Integrator::Verlet => Self::Verlet(Verlet::new(system)),
            Integrator::LinearlyImplicitEuler => {
                Self::LinearlyImplicitEuler(LinearlyImplicitEuler::new(solver(), tolerance, system))
            }
            Integrator::ImplicitEuler => Self::ImplicitEuler(ImplicitEuler::new(newton(), system)),
            Integrator::Static => Self::Static(Statics::new(newton(), system, method.load_steps)),
        }
    }

    /// Advances by one step. After an error the state is of no use. `springs` are the pulls at its end.
    pub(super) fn step(
        &mut self,
        pulls: &Pulls<T>,
        springs: &[AnchorSpring<T>],
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let system = pulls.system;
        let converged = match self {
            Self::ExplicitEuler(method) => method.step(pulls, state, dt, counters).map(|()| true),
            Self::SemiImplicitEuler(method) => method.step(pulls, state, dt, counters).map(|()| true),
            Self::Rk2(method) => method.step(pulls, state, dt, counters).map(|()| true),
            Self::Rk4(method) => method.step(pulls, state, dt, counters).map(|()| true),
            Self::Verlet(method) => method.step(pulls, state, dt, counters).map(|()| true),
            Self::LinearlyImplicitEuler(method) => method.step(system, state, springs, dt, counters).map(|()| true),
            Self::ImplicitEuler(method) => method.step(system, state, springs, dt, counters),
            Self::Static(method) => method.step(system, state, springs, counters),
        }?;
        counters.unconverged_steps += usize::from(!converged);
        Ok(())
    }

    /// The linear solver, where there is one.
    pub(super) fn solver(&self) -> Option<&Solver<T>> {
        match self {
            Self::ImplicitEuler(method) => Some(method.newton.solver()),
            Self::LinearlyImplicitEuler(method) => Some(method.solver()),
            Self::Static(method) => Some(method.solver()),
            _ => None,
        }
    }

    /// Whether it searches along directions, and so needs energies.
    pub(super) fn searches(&self) -> bool {
        match self {
            Self::ImplicitEuler(_) => true,
            Self::Static(method) => !method.is_linear(),
            _ => false,
        }
    }

    /// Part of the loads that acts after so many steps.
    pub(super) fn load_fraction(&self, steps: usize) -> f64 {
        if let Self::Static(method) = self { method.fraction(steps) } else { 1.0 }
    }

    /// What is known from earlier steps is of no use any more: a parameter has changed, or the body is back at rest.
    pub(super) fn forget(&mut self) {
        match self {
            Self::ImplicitEuler(method) => method.forget(),
            Self::Static(method) => method.forget(),
            Self::Verlet(method) => method.forget(),
            _ => {}
        }
    }
}

/// Iterations that a step in time may take, and a search for equilibrium: one that has lost its balance goes a long way downhill.
const MOST_ITERATIONS: (usize, usize) = (50, 2000);

/// The scene's, or those that suit most.
fn limits(method: &Method, integrator: Integrator, solver_tolerance: f64) -> Limits {
    let newton = &method.newton;
    let most = if integrator == Integrator::Static { MOST_ITERATIONS.1 } else { MOST_ITERATIONS.0 };
    Limits {
        max_iterations: newton.max_iterations.unwrap_or(most),
        tolerance: newton.tolerance.unwrap_or(1e-10),
        projection: newton.projection,
        solver_tolerance: solver_tolerance.min(COARSEST),
    }
}
