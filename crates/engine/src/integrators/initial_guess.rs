//! The initial guess of a step of an implicit method: an increment of finite energy that satisfies the Dirichlet conditions.

use fem_model::simulation::{Cause, Counters};

use super::followers::Followers;
use crate::model::system::System;
use crate::newton::incremental_potential::{Increment, Inertia};
use crate::newton::{Convergence, Newton, Start};
use fem_elements::vector::triple;
use fem_solvers::Real;

/// A step in need of an initial guess.
pub struct InitialGuess<'a, T: Real> {
    /// The method that starts there.
    pub newton: &'a mut Newton<T>,
    /// Follower loads, evaluated for the step.
    pub followers: &'a mut Followers<T>,
    /// The body.
    pub system: &'a System<T>,
    /// The step.
    pub increment: Increment<'a, T>,
    /// Its inertia.
    pub inertia: Inertia<'a, T>,
}

/// Smallest part of a prescribed motion within a step that is tried.
const SMALLEST_PART: f64 = 1.0 / 1024.0;

impl<T: Real> InitialGuess<'_, T> {
    /// Replaces `step`, an extrapolation, by the minimum of the incremental potential. If Newton's method fails from the first feasible
    /// candidate, which may be far from the state, it starts again from the state itself with the prescribed increments.
    pub fn minimize(&mut self, step: &mut [[T; 3]], counters: &mut Counters) -> Result<Convergence, Cause> {
        let start = self.find(step, counters)?;
        let outcome = self.descend(start, step, counters);
        if !matches!(outcome, Err(Cause::Stuck { .. })) {
            return outcome;
        }
        self.newton.forget();
        step.fill([T::default(); 3]);
        self.prescribe(step);
        self.followers.evaluate(self.system, &self.increment, step);
        match self.start(step, counters) {
            Some(start) => self.descend(start, step, counters),
            None => outcome,
        }
    }

    fn descend(&mut self, start: Start, step: &mut [[T; 3]], counters: &mut Counters) -> Result<Convergence, Cause> {
        let Self { newton, followers, system, increment, .. } = self;
        followers.minimize(newton, system, *increment, start, step, counters)
    }

    /// Replaces `step`, an extrapolation, by a feasible increment. Candidates in this order: the extrapolation; the increment without
    /// forces; that of a linear body; the prescribed increments alone. Where a prescribed motion inverts elements in all of them,
    /// it is applied in parts, with the body in equilibrium after each. Returns the energy at the increment.
    fn find(&mut self, step: &mut [[T; 3]], counters: &mut Counters) -> Result<Start, Cause> {
        self.prescribe(step);
        if let Some(start) = self.start(step, counters) {
            return Ok(start);
        }
        step.copy_from_slice(self.inertia.inertial);
        self.prescribe(step);
        if let Some(start) = self.start(step, counters) {
            return Ok(start);
        }
        // The rest is rare, and allocates only then.
        let mut prescribed = vec![[T::default(); 3]; self.system.nodes()];
        self.prescribe(&mut prescribed);
        // If the linear body has no stiffness, the other candidates are tried.
        if self.system.dirichlet.has_motion()
            && self.predict(self.increment, &prescribed, step, counters)
            && let Some(start) = self.start(step, counters)
        {
            return Ok(start);
        }
        step.copy_from_slice(&prescribed);
        if let Some(start) = self.start(step, counters) {
            return Ok(start);
        }
        self.in_parts(&prescribed, step, counters)
    }

    /// Applies the prescribed motion in parts, as large as the elements allow.
    fn in_parts(
        &mut self,
        prescribed: &[[T; 3]],
        step: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<Start, Cause> {
        let system = self.system;
        let mut found = vec![[T::default(); 3]; system.nodes()];
        let (mut done, mut part) = (0.0, 0.5);
        while system.dirichlet.has_motion() && part >= SMALLEST_PART {
            let next = f64::min(done + part, 1.0);
            let start = self.continue_from(&found, prescribed, (done, next), step, counters);
            let Self { newton, followers, increment, .. } = self;
            if let Some(start) = start
                && followers.minimize(newton, system, *increment, start, step, counters).is_ok()
            {
                found.copy_from_slice(step);
                (done, part) = (next, 2.0 * part);
            } else {
                part *= 0.5;
            }
            if done == 1.0 {
                return self.start(step, counters).ok_or(Cause::Overflow);
            }
        }
        Err(infeasible(system, self.increment.start, prescribed))
    }

    /// Finds a feasible increment from equilibrium at one part of the motion to the next part: the increment of a linear body, or else
    /// that of the constrained degrees of freedom alone. Returns `None` if neither is feasible.
    fn continue_from(
        &mut self,
        found: &[[T; 3]],
        prescribed: &[[T; 3]],
        (done, next): (f64, f64),
        step: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Option<Start> {
        let sum = |a: &[[T; 3]], factor: f64, b: &[[T; 3]]| -> Vec<[T; 3]> {
            let add = |(a, b): (&[T; 3], &[T; 3])| triple(|i| a[i] + T::of(factor) * b[i]);
            a.iter().zip(b).map(add).collect()
        };
        let zero = vec![[T::default(); 3]; prescribed.len()];
        let (start, inertial) = (sum(self.increment.start, 1.0, found), sum(self.inertia.inertial, -1.0, found));
        let part = sum(&zero, next - done, prescribed);
        let inertia = Some(Inertia { inertial: &inertial, ..self.inertia });
        let from_here = Increment { start: &start, inertia, end: self.increment.end };
        for follows in [true, false] {
            if follows && !self.predict(from_here, &part, step, counters) {
                continue;
            }
            let added = if follows { &*step } else { &part };
            let total = sum(found, 1.0, added);
            step.copy_from_slice(&total);
            if next == 1.0 {
                self.system.dirichlet.copy_constrained(prescribed, step);
            }
            let start = self.start(step, counters);
            if start.is_some() {
                return start;
            }
        }
        None
    }

    /// Writes the increment of a linear body into `step`; returns false if its matrix cannot be factored.
    fn predict(
        &mut self,
        increment: Increment<T>,
        prescribed: &[[T; 3]],
        step: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> bool {
        let Self { newton, followers, system, .. } = self;
        newton.predict(&followers.potential(system, increment), prescribed, step, counters).is_ok()
    }

    /// Overwrites the constrained entries.
    fn prescribe(&self, step: &mut [[T; 3]]) {
        self.increment.prescribe(self.system, step);
    }

    /// Evaluates an increment, which is moved out of obstacles first; `None` if Newton's method cannot start there.
    fn start(&mut self, step: &mut [[T; 3]], counters: &mut Counters) -> Option<Start> {
        let Self { newton, followers, system, increment, .. } = self;
        increment.make_feasible(system, step);
        newton.start(&followers.potential(system, *increment), step, counters)
    }
}

/// The cause of an infeasible start: an element that is inverted at the displacements u or after the prescribed increments, or else
/// a number that is too large.
pub fn infeasible<T: Real>(system: &System<T>, u: &[[T; 3]], prescribed: &[[T; 3]]) -> Cause {
    let add = |(u, prescribed): (&[T; 3], &[T; 3])| triple(|i| u[i] + prescribed[i]);
    let end: Vec<[T; 3]> = u.iter().zip(prescribed).map(add).collect();
    for u in [u, &end] {
        let (J, element) = system.elements.min_det_F(u);
        // NaN fails the comparison.
        if !(J > T::default()) {
            return Cause::Inverted { element, J: J.as_f64() };
        }
    }
    Cause::Overflow
}
