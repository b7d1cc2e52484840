//! Time integration methods, one file each, behind the trait [`Integrator`]. For the choice of a method, with figures, see
//! `include-docs/methods.md` in the repository.

mod accelerations;
mod arc_length;
mod balance;
mod critical_time_step;
mod descent;
mod explicit_euler;
mod followers;
mod implicit_euler;
mod impulses;
mod initial_guess;
mod last_change;
mod linearly_implicit_euler;
mod load_step;
mod mass_inverse;
mod momentum;
mod pbd;
mod prescribed_motion;
mod projection;
mod projective_dynamics;
mod proximal;
mod relaxation;
mod rk2;
mod rk4;
mod second_order;
mod semi_implicit_euler;
mod statics;
mod vbd;
mod verlet;
mod xpbd;

pub use accelerations::{Accelerations, Stage, StageWork};
pub use critical_time_step::critical_time_step;
pub use explicit_euler::ExplicitEuler;
pub use implicit_euler::ImplicitEuler;
pub use impulses::{Impulse, Impulses};
pub use linearly_implicit_euler::LinearlyImplicitEuler;
pub use mass_inverse::MassInverse;
pub use pbd::pbd;
pub use projective_dynamics::ProjectiveDynamics;
pub use relaxation::PlaneContacts;
pub use rk2::Rk2;
pub use rk4::Rk4;
pub use second_order::{Scheme, SecondOrder};
pub use semi_implicit_euler::SemiImplicitEuler;
pub use statics::Statics;
pub use vbd::vbd;
pub use verlet::Verlet;
pub use xpbd::xpbd;

pub use crate::newton::{Convergence, LastEvaluation};
#[cfg(feature = "gpu")]
pub(crate) use relaxation::{color_nodes, shape};

use fem_model::simulation::{Cause, Counters, History};
use fem_model::{Integrator as Kind, Method};

use crate::forces::Moment;
use crate::forces::contact::planes::Planes;
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::Newton;
use fem_solvers::{Real, Solver};

/// The parts that an integrator may need.
pub struct Parts<'a, T: Real> {
    /// Its parameters.
    pub method: &'a Method,
    /// The body.
    pub system: &'a System<T>,
    /// Obstacles, if the body has any.
    pub planes: Option<&'a Planes>,
    /// Analyses the pattern of the matrix.
    pub solver: &'a dyn Fn() -> Solver<T>,
    /// Newton's method with its solver.
    pub newton: &'a dyn Fn() -> Newton<T>,
    /// Relative residual of a linear solve.
    pub tolerance: f64,
}

/// The integrator of that name.
pub fn build<T: Real>(kind: Kind, parts: &Parts<T>) -> Box<dyn Integrator<T>> {
    let Parts { method, system, planes, solver, newton, tolerance } = *parts;
    match kind {
        Kind::ExplicitEuler => Box::new(ExplicitEuler::new(system)),
        Kind::SemiImplicitEuler => Box::new(SemiImplicitEuler::new(system)),
        Kind::Rk2 => Box::new(Rk2::new(system)),
        Kind::Rk4 => Box::new(Rk4::new(system)),
        Kind::Verlet => Box::new(Verlet::new(system)),
        Kind::LinearlyImplicitEuler => Box::new(LinearlyImplicitEuler::new(solver(), tolerance, system)),
        Kind::ImplicitEuler => Box::new(ImplicitEuler::new(newton(), system)),
        Kind::Static if method.arc_length => Box::new(Statics::by_arc_length(newton(), system, method.load_steps)),
        Kind::Static => Box::new(Statics::new(newton(), system, method.load_steps)),
        Kind::Xpbd => Box::new(xpbd(&method.iterations, system, planes)),
        Kind::Pbd => Box::new(pbd(&method.iterations, system, planes)),
        Kind::Vbd => Box::new(vbd(&method.iterations, system, planes)),
        Kind::ProjectiveDynamics => Box::new(ProjectiveDynamics::new(method.iterations, solver(), system)),
        second_order => {
            let scheme = Scheme::new(second_order, method).expect("an implicit method of second order");
            Box::new(SecondOrder::new(scheme, newton(), system, method.adaptive.is_some()))
        }
    }
}

/// The quantities that a time integration method keeps from step to step, such as accelerations. A method that keeps some implements all of
/// these functions; one that keeps none is [`Memoryless`].
pub trait Memory {
    /// The last step has been accepted: the next one starts where it ended. Until then a step may be repeated from its start.
    fn accept(&mut self);

    /// Drops everything kept from earlier steps: the state or a parameter has changed.
    fn forget(&mut self);

    /// Drops what depends on the external forces at the end of the last step: a user's interaction has changed them.
    fn forget_forces(&mut self);

    /// Adds what it keeps from step to step to a history.
    fn save(&self, history: &mut History);

    /// Restores the quantities that [`save`](Self::save) has added, so that later steps are equal bit for bit.
    fn restore(&mut self, history: &History) -> Result<(), String>;
}

/// A method whose steps depend on the state at their start alone.
pub trait Memoryless {}

impl<M: Memoryless> Memory for M {
    fn accept(&mut self) {}

    fn forget(&mut self) {}

    fn forget_forces(&mut self) {}

    fn save(&self, _: &mut History) {}

    fn restore(&mut self, _: &History) -> Result<(), String> {
        Ok(())
    }
}

/// A time integration method. Its methods have a default where that holds for any method, or says that the method has no such quantity.
pub trait Integrator<T: Real>: Memory + Send {
    /// Advances displacements and velocities of the state by one step of `dt` seconds; time and step number stay. After an error the
    /// state must not be used.
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause>;

    /// The moment at which the forces of a state are evaluated.
    fn moment(&self, state: &State<T>) -> Moment {
        Moment::at(state.time)
    }

    /// The stage at which the last step has solved the equation of motion; `None` for its end, and before the first step.
    fn last_stage(&self) -> Option<LastStage<'_, T>> {
        None
    }

    /// Estimate of the largest error of a displacement in the last step, m; `None` for a method without one.
    fn estimated_error(&self) -> Option<f64> {
        None
    }

    /// The linear solver of an implicit method.
    fn solver(&self) -> Option<&Solver<T>> {
        None
    }

    /// Returns true if a step may end far from the solution of its equation unnoticed, because it takes a number of iterations that
    /// the scene has set.
    fn may_stop_early(&self) -> bool {
        false
    }

    /// Returns true if the velocities lie half a step behind the displacements: their mean over a step is the velocity at its start.
    fn has_staggered_velocities(&self) -> bool {
        false
    }

    /// Works in the last step, if the method sums them over its stages.
    fn work_of_stages(&self) -> Option<StageWork> {
        None
    }

    /// Reactions and damping at the [stage](Self::last_stage) of the last step, or at its end, if its equation was solved there; `None` for
    /// methods that do not store them.
    fn last_evaluation(&self) -> Option<&LastEvaluation<T>> {
        None
    }

    /// Work of the impulses with which prescribed velocities have jumped at the start of the last step, J.
    fn work_of_jump(&self) -> f64 {
        0.0
    }

    /// The kinetic energy of a state that ends a step of `dt` seconds, which the method keeps together with the elastic energy of a linear
    /// body, J.
    fn kinetic_energy(&self, system: &System<T>, state: &State<T>, _dt: f64) -> f64 {
        system.mass.kinetic_energy(&state.v)
    }

    /// Contacts with planes of a method that projects nodes onto them in its iterations.
    fn plane_contacts(&self) -> Option<&PlaneContacts> {
        None
    }
}

/// A stage within a step: displacements, velocities and time are those at the end of the step times `part`, and the rest those at its
/// start.
#[derive(Clone, Copy, Debug)]
pub struct LastStage<'a, T> {
    /// The part of the step before it.
    pub part: f64,
    /// Accelerations there, m/s².
    pub acceleration: &'a [[T; 3]],
}
