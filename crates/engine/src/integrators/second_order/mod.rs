//! Implicit methods of second order. Each is a set of coefficients; a step is one minimization of the incremental potential.
//!
//! Prescribed motions enter with their exact velocities and accelerations. Damping takes its stiffness at displacements
//! extrapolated with the velocity at the start: with those at the start a step would be of first order. Forces of obstacles act at the
//! end of a step, whatever the stage.

mod advance;
mod bathe;
mod bdf2;
mod coefficients;
mod error;
mod first_step;
mod generalized_alpha;
mod history;
mod implicit_midpoint;
mod newmark;
mod start;

use fem_model::simulation::{Cause, Counters, History};
use fem_model::{Integrator as Kind, Method, NewmarkParameters};

use super::followers::Followers;
use super::{Convergence, Integrator, LastStage, Memory};
use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::{LastEvaluation, Newton};
use coefficients::Coefficients;
use fem_elements::history::{put, put_option, take, take_option};
use fem_solvers::{Real, Solver};
use history::Known;
use start::Start;

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
    /// Bathe's method.
    Bathe,
}

impl Scheme {
    /// The method that a scene names; `None` if it belongs to another family.
    pub fn new(kind: Kind, method: &Method) -> Option<Self> {
        match kind {
            Kind::ImplicitMidpoint => Some(Self::ImplicitMidpoint),
            Kind::Newmark => Some(Self::Newmark(method.newmark)),
            Kind::GeneralizedAlpha => Some(Self::GeneralizedAlpha(method.rho_inf)),
            Kind::Bdf2 => Some(Self::Bdf2),
            Kind::Bathe => Some(Self::Bathe),
            _ => None,
        }
    }

    /// Coefficients of a step of `dt` seconds after one of `before` seconds; `None` for a step that has two stages.
    pub(super) fn coefficients(self, dt: f64, before: Option<f64>) -> Option<Coefficients> {
        match self {
            Self::ImplicitMidpoint => Some(implicit_midpoint::coefficients(dt)),
            Self::Newmark(parameters) => Some(newmark::coefficients(parameters, dt)),
            Self::GeneralizedAlpha(rho_inf) => Some(generalized_alpha::coefficients(rho_inf, dt)),
            Self::Bdf2 => before.map(|before| bdf2::coefficients(dt, dt / before)),
            Self::Bathe => None,
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
        matches!(self, Self::Newmark(_) | Self::GeneralizedAlpha(_) | Self::Bathe)
    }

    /// |C| of the local error C dt³ u‴ of the displacements of a step with this ratio to the one before, small vibrations assumed.
    ///
    /// Newmark: Zienkiewicz, Xie, A Simple Error Estimator and Adaptive Time Stepping Procedure for Dynamic Analysis (1991); in the
    /// generalized-α method accelerations are those of (α_f − α_m) dt before. BDF2: Hairer, Nørsett, Wanner, Solving Ordinary
    /// Differential Equations I (1993), III.5.
    fn error_constant(self, ratio: Option<f64>) -> f64 {
        match (self, ratio) {
            (Self::ImplicitMidpoint, _) => 1.0 / 12.0,
            (Self::Newmark(parameters), _) => parameters.beta - 1.0 / 6.0,
            (Self::GeneralizedAlpha(rho_inf), _) => {
                let (alpha_m, alpha_f) = ((2.0 * rho_inf - 1.0) / (rho_inf + 1.0), rho_inf / (rho_inf + 1.0));
                0.25 * (1.0 - alpha_m + alpha_f).powi(2) - 1.0 / 6.0 - 0.5 * (alpha_f - alpha_m)
            }
            (Self::Bdf2, Some(r)) => (1.0 + r).powi(2) / (6.0 * r * (1.0 + 2.0 * r)),
            // 1/6 − 3γ² + 2γ³ of Alexander's method, γ = 1 − 1/√2.
            (Self::Bdf2, None) => 0.0404,
            // (3γ² − 4γ + 2)/(12 (2 − γ)) of TR-BDF2, γ = 2 − √2.
            (Self::Bathe, _) => 0.0404,
        }
    }
}

/// An implicit method of second order with its solver and vectors.
pub struct SecondOrder<T: Real> {
    scheme: Scheme,
    newton: Newton<T>,
    followers: Followers<T>,
    start: Start<T>,
    /// State of earlier steps that this step needs, and the state for the next step.
    known: Known<T>,
    next: Known<T>,
    /// The same at the stage of a step that has two; empty for methods without.
    middle: Known<T>,
    inertial: Vec<[T; 3]>,
    still: Vec<[T; 3]>,
    stiffness_at: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
    /// Velocity at the end as far as it is known at the start, m/s.
    velocity: Vec<[T; 3]>,
    /// Acceleration of the last step's stage, m/s²; the initial guess of the next step assumes the same.
    acceleration: Vec<[T; 3]>,
    /// θ of the last step.
    stage: Option<f64>,
    /// True if Newton's last evaluation is that of the last step's stage, with all forces there.
    has_evaluation: bool,
    /// True if each step estimates its error.
    estimates: bool,
    /// Error estimate of the last step, m.
    error: Option<f64>,
    /// Velocities at the start of a step that estimates its error, m/s.
    before: Vec<[T; 3]>,
}

impl<T: Real> SecondOrder<T> {
    /// Allocates its vectors for a body. `estimates` tells whether each step estimates its error.
    pub fn new(scheme: Scheme, newton: Newton<T>, system: &System<T>, estimates: bool) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let may_settle = scheme.has_acceleration() && (system.is_damped() || scheme.overshoot() > 0.0);
        let has_step = matches!(scheme, Scheme::Bdf2 | Scheme::Bathe) || may_settle;
        let known = Known::new(system.nodes(), [scheme.has_acceleration(), has_step, estimates]);
        let middle = if scheme == Scheme::Bathe { known.clone() } else { Known::default() };
        Self {
            scheme,
            newton,
            followers: Followers::new(system),
            start: Start::new(system),
            next: known.clone(),
            known,
            middle,
            inertial: zero(),
            still: zero(),
            stiffness_at: zero(),
            step: zero(),
            velocity: zero(),
            acceleration: zero(),
            stage: None,
            has_evaluation: false,
            estimates,
            error: None,
            before: vec![[T::default(); 3]; if estimates { system.nodes() } else { 0 }],
        }
    }

    /// Brings the history up to date with the state at the start of a step.
    fn begin(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        self.start.work = 0.0;
        if system.dirichlet.has_motion() && self.start.jump(system, state, dt)? {
            self.known.forget();
        }
        let Self { scheme, start, known, acceleration, .. } = self;
        if scheme.has_acceleration() && !known.has_acceleration {
            let a = &mut known.acceleration;
            start.accelerations(system, state, dt, a, counters)?;
            known.has_acceleration =
                !(start.is_overdamped(system, state, dt, &state.v)? || start.is_overdamped(system, state, dt, a)?);
            acceleration.copy_from_slice(a);
            if known.has_acceleration && start.is_unresolved(system, state, dt, (a, scheme.overshoot())) {
                self.smooth_acceleration(system, state, dt, counters)?;
            }
        }
        let Self { start, known, estimates, .. } = self;
        if *estimates && known.age.is_none() {
            if known.has_acceleration {
                known.mean.copy_from_slice(&known.acceleration);
            } else {
                start.accelerations(system, state, dt, &mut known.mean, counters)?;
            }
            known.age = Some(0.0);
        }
        Ok(())
    }
}

impl<T: Real> Memory for SecondOrder<T> {
    fn accept(&mut self) {
        std::mem::swap(&mut self.known, &mut self.next);
    }

    fn forget(&mut self) {
        self.newton.forget();
        self.known.forget();
        self.acceleration.fill([T::default(); 3]);
        self.stage = None;
    }

    fn forget_forces(&mut self) {
        // Forces jump, and with them the acceleration; the difference quotients of a multistep method must not reach across that.
        self.known.forget();
    }

    fn save(&self, history: &mut History) {
        self.known.save(history);
        put(history, "second_order.last_change", self.acceleration.as_flattened());
        put_option(history, "second_order.stage", self.stage);
        self.newton.save(history);
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        self.known.restore(history)?;
        take(history, "second_order.last_change", self.acceleration.as_flattened_mut())?;
        self.stage = take_option(history, "second_order.stage")?;
        self.newton.restore(history)
    }
}

impl<T: Real> Integrator<T> for SecondOrder<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        self.begin(system, state, dt, counters)?;
        let (before, end) = (self.known.dt, Moment::at(state.time + dt));
        self.error = None;
        if self.estimates {
            self.before.copy_from_slice(&state.v);
        }
        // Forces of obstacles act at the end.
        self.has_evaluation = !system.forces.has_obstacles();
        let convergence = match self.scheme.coefficients(dt, before) {
            _ if self.scheme.has_acceleration() && !self.known.has_acceleration => {
                self.settle(system, state, dt, counters)?
            }
            Some(of) => self.advance(system, state, (dt, end), &of, counters)?,
            None if self.scheme == Scheme::Bathe => self.two_stages(system, state, dt, counters)?,
            None => self.first_step(system, state, dt, counters)?,
        };
        if self.estimates {
            self.keep_mean(system, state, dt)?;
            self.estimate(system, dt, before.map(|before| dt / before));
        }
        Ok(convergence)
    }

    fn solver(&self) -> Option<&Solver<T>> {
        Some(self.newton.solver())
    }

    fn last_evaluation(&self) -> Option<&LastEvaluation<T>> {
        self.has_evaluation.then(|| self.newton.last_evaluation())
    }

    fn last_stage(&self) -> Option<LastStage<'_, T>> {
        Some(LastStage { part: self.stage?, acceleration: &self.acceleration })
    }

    fn estimated_error(&self) -> Option<f64> {
        self.error
    }

    fn work_of_jump(&self) -> f64 {
        self.start.work
    }

    /// Newmark's method keeps ½ vᵀ M v + ½ uᵀ K u + ½ (β − γ/2) dt² aᵀ M a if γ = ½, and lowers it if γ is larger: Krenk, Energy Conservation
    /// in Newmark Based Time Integration Algorithms (2006).
    fn kinetic_energy(&self, system: &System<T>, state: &State<T>, dt: f64) -> f64 {
        let kinetic = system.mass.kinetic_energy(&state.v);
        match self.scheme {
            Scheme::Newmark(values) if self.known.has_acceleration => {
                let factor = values.beta - 0.5 * values.gamma;
                kinetic + factor * dt.powi(2) * system.mass.kinetic_energy(&self.known.acceleration)
            }
            _ => kinetic,
        }
    }
}
