//! One load step of a nonlinear body, in smaller parts where Newton's method fails.

use fem_model::simulation::{Cause, Counters};

use super::Convergence;
use super::balance::Balance;
use super::followers::Followers;
use super::initial_guess::infeasible;
use super::proximal::Proximal;
use crate::forces::Moment;
use crate::model::system::System;
use crate::newton::Newton;
use crate::newton::incremental_potential::{Increment, Inertia};
use fem_elements::vector::axpy;
use fem_solvers::Real;

/// Newton's method for load steps, with its vectors.
pub struct LoadStep<T: Real> {
    /// Newton's method.
    pub newton: Newton<T>,
    followers: Followers<T>,
    prescribed: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
    balance: Balance<T>,
    /// The stabilization of a body that nothing but obstacles can hold.
    proximal: Option<Proximal<T>>,
}

/// Largest number of times that a load step is halved.
const HALVINGS: i32 = 10;

/// Tolerance of Newton's method where forces are not in balance, as a part of the given one.
const FINEST: f64 = 1e-6;

impl<T: Real> LoadStep<T> {
    /// Allocates its vectors for a body.
    pub fn new(newton: Newton<T>, system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let proximal = system.modulus_of_free_body.map(|modulus| Proximal::new(system, modulus));
        let (followers, balance) = (Followers::new(system), Balance::new(system));
        Self { newton, followers, prescribed: zero(), step: zero(), balance, proximal }
    }

    /// From one moment to another, in smaller parts where Newton's method fails.
    pub fn advance(
        &mut self,
        system: &System<T>,
        u: &mut [[T; 3]],
        (start, end): (Moment, Moment),
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let (mut at, mut part) = (0.0, 1.0);
        let mut convergence = Convergence::Converged;
        loop {
            let next = if at + part >= 1.0 - 1e-9 { 1.0 } else { at + part };
            let outcome = self.equilibrate(system, u, start.towards(end, next), counters);
            let is_smallest = part <= 0.5f64.powi(HALVINGS);
            match outcome {
                Ok(reached) if reached == Convergence::Converged || is_smallest => {
                    axpy(1.0, &self.step, u);
                    if reached == Convergence::NotConverged {
                        convergence = reached;
                    }
                    at = next;
                    part *= 2.0;
                }
                // Smaller loads would not help.
                Err(cause) if is_smallest || matches!(cause, Cause::Adrift { .. } | Cause::RoundOff { .. }) => {
                    return Err(cause);
                }
                _ => part *= 0.5,
            }
            if at >= 1.0 {
                return Ok(convergence);
            }
        }
    }

    /// Writes the increment from u to equilibrium at a moment into `step`. An error where forces are not in balance there.
    fn equilibrate(
        &mut self,
        system: &System<T>,
        u: &[[T; 3]],
        end: Moment,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let outcome = self.find_equilibrium(system, u, end, counters)?;
        let tolerance = self.newton.limits().tolerance;
        let balanced = self.balance.check(system, (u, &self.step), end, tolerance);
        if outcome == Convergence::NotConverged || balanced.is_ok() {
            return Ok(outcome);
        }
        if self.proximal.is_none() {
            self.refine(system, u, end, counters);
        }
        self.balance.check(system, (u, &self.step), end, tolerance).map(|()| outcome)
    }

    /// Goes on from `step` with a smaller tolerance, as far as Newton's method gets: forces show whether that is far enough.
    fn refine(&mut self, system: &System<T>, u: &[[T; 3]], end: Moment, counters: &mut Counters) {
        let Self { newton, followers, step, .. } = self;
        let increment = Increment { start: u, end, inertia: None };
        let tolerance = newton.limits().tolerance;
        newton.forget();
        newton.set_tolerance(FINEST * tolerance);
        if let Some(start) = newton.start(&followers.potential(system, increment), step, counters) {
            // An error may mean that rounding errors alone are left.
            let _ = followers.minimize(newton, system, increment, start, step, counters);
        }
        newton.set_tolerance(tolerance);
    }

    /// The same without a look at the forces.
    fn find_equilibrium(
        &mut self,
        system: &System<T>,
        u: &[[T; 3]],
        end: Moment,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Some(mut proximal) = self.proximal.take() else { return self.minimize(system, u, end, None, counters) };
        proximal.begin(u);
        let outcome = loop {
            let inertia = proximal.inertia();
            match self.minimize(system, &proximal.u, end, Some(inertia), counters) {
                Ok(Convergence::Converged) => {}
                outcome => break outcome,
            }
            match proximal.review(system, end, &self.step) {
                Ok(true) => break Ok(Convergence::Converged),
                Ok(false) => {}
                Err(cause) => break Err(cause),
            }
        };
        for (step, (end, start)) in
            self.step.as_flattened_mut().iter_mut().zip(proximal.u.as_flattened().iter().zip(u.as_flattened()))
        {
            *step = *end - *start;
        }
        self.proximal = Some(proximal);
        outcome
    }

    /// Writes the increment from u to the minimum of the energy at a moment, with the term of a stabilization, into `step`.
    fn minimize(
        &mut self,
        system: &System<T>,
        u: &[[T; 3]],
        end: Moment,
        inertia: Option<Inertia<T>>,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { newton, followers, prescribed, step, .. } = self;
        let increment = Increment { start: u, end, inertia };
        step.fill([T::default(); 3]);
        followers.evaluate(system, &increment, step);
        system.prescribe(u, end, prescribed);
        // A free body would fall through its obstacles in the linear guess.
        let guessed = match inertia {
            Some(_) if !system.dirichlet.has_motion() => None,
            _ => {
                newton.predict(&followers.potential(system, increment), prescribed, step, counters)?;
                system.make_feasible(u, end, step);
                newton.start(&followers.potential(system, increment), step, counters)
            }
        };
        let start = match guessed {
            Some(start) => start,
            None => {
                step.copy_from_slice(prescribed);
                system.make_feasible(u, end, step);
                let start = newton.start(&followers.potential(system, increment), step, counters);
                start.ok_or_else(|| infeasible(system, u, prescribed))?
            }
        };
        followers.minimize(newton, system, increment, start, step, counters)
    }
}
