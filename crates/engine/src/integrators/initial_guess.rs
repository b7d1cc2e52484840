//! Where Newton's method starts a step of implicit Euler: at a finite energy, with held directions where they are led.

use super::follower::Loads;
use crate::model::system::System;
use crate::newton::Newton;
use crate::newton::incremental_potential::{IncrementalPotential, Motion};
use crate::number::Real;
use fem_scene::simulation::{Cause, Counters};

/// What the search for a start works with.
pub struct Start<'a, T: Real> {
    /// The method that starts there.
    pub newton: &'a mut Newton<T>,
    /// Loads, gathered for the step.
    pub loads: &'a mut Loads<T>,
    /// What the step minimises.
    pub objective: IncrementalPotential<'a, T>,
    /// What makes it a motion.
    pub motion: Motion<'a, T>,
    /// Seconds at the end of the step.
    pub end: f64,
}

/// A prescribed motion is cut into pieces of no less than this part of what it does in a step.
const LEAST_PIECE: f64 = 1.0 / 1024.0;

impl<T: Real> Start<'_, T> {
    /// Finds a start, tried in this order: the likely step, which `step` holds; that without forces; that of a body that is
    /// linear for as long as the step lasts; none. Where a prescribed motion squashes elements in all of them, it is done in
    /// pieces, with the body in balance after each: no element is turned inside out on that way.
    pub fn find(&mut self, step: &mut [[T; 3]], counters: &mut Counters) -> Result<(), Cause> {
        let system = self.objective.system;
        self.lead(step);
        if self.can_start(step, counters) {
            return Ok(());
        }
        step.copy_from_slice(self.motion.inertial);
        self.lead(step);
        if self.can_start(step, counters) {
            return Ok(());
        }
        // What follows is rare, and takes its memory only then.
        let mut led = vec![[T::default(); 3]; system.nodes()];
        self.lead(&mut led);
        if system.held.leads() {
            let Self { newton, loads, objective, .. } = self;
            // Where that linear body has no stiffness, the others are left.
            let predicted = newton.predict(&loads.on(*objective), &led, step, counters).is_ok();
            if predicted && self.can_start(step, counters) {
                return Ok(());
            }
        }
        step.copy_from_slice(&led);
        if self.can_start(step, counters) {
            return Ok(());
        }
        self.in_pieces(&led, step, counters)
    }

    /// The step at the end of the prescribed motion, found piece by piece.
    fn in_pieces(&mut self, led: &[[T; 3]], step: &mut [[T; 3]], counters: &mut Counters) -> Result<(), Cause> {
        let IncrementalPotential { system, start, .. } = self.objective;
        let mut found = vec![[T::default(); 3]; system.nodes()];
        let (mut done, mut piece) = (0.0, 0.5);
        while system.held.leads() && piece >= LEAST_PIECE {
            let next = f64::min(done + piece, 1.0);
            let is_start = self.go_on(&found, led, (done, next), step, counters);
            let Self { newton, loads, objective, .. } = self;
            if is_start && loads.minimize(newton, *objective, 1.0, step, counters).is_ok() {
                found.copy_from_slice(step);
                (done, piece) = (next, 2.0 * piece);
            } else {
                piece *= 0.5;
            }
            if done == 1.0 {
                return Ok(());
            }
        }
        Err(no_start(system, start, led))
    }

    /// From balance at one part of the motion to a start at the next: as a linear body follows, or else by the held directions
    /// alone. False where neither has a finite energy.
    fn go_on(
        &mut self,
        found: &[[T; 3]],
        led: &[[T; 3]],
        (done, next): (f64, f64),
        step: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> bool {
        let sum = |a: &[[T; 3]], factor: f64, b: &[[T; 3]]| -> Vec<[T; 3]> {
            let add = |(a, b): (&[T; 3], &[T; 3])| std::array::from_fn(|i| a[i] + T::of(factor) * b[i]);
            a.iter().zip(b).map(add).collect()
        };
        let still = vec![[T::default(); 3]; led.len()];
        let (start, inertial) = (sum(self.objective.start, 1.0, found), sum(self.motion.inertial, -1.0, found));
        let piece = sum(&still, next - done, led);
        let motion = Some(Motion { inertial: &inertial, ..self.motion });
        let from_here = IncrementalPotential { start: &start, motion, ..self.objective };
        for follows in [true, false] {
            let Self { newton, loads, .. } = self;
            if follows && newton.predict(&loads.on(from_here), &piece, step, counters).is_err() {
                continue;
            }
            let added = if follows { &*step } else { &piece };
            let total = sum(found, 1.0, added);
            step.copy_from_slice(&total);
            if next == 1.0 {
                self.objective.system.held.copy(led, step);
            }
            if self.can_start(step, counters) {
                return true;
            }
        }
        false
    }

    /// Writes the step of held directions.
    fn lead(&self, step: &mut [[T; 3]]) {
        let IncrementalPotential { system, start, .. } = self.objective;
        system.lead(|motion| motion.fraction(self.end), start, step);
    }

    fn can_start(&mut self, step: &[[T; 3]], counters: &mut Counters) -> bool {
        self.newton.can_start(&self.loads.on(self.objective), step, counters)
    }
}

/// Why there is no start: an element that is inside out, where the body is or where held directions lead it, or else a number
/// that is too large.
pub fn no_start<T: Real>(system: &System<T>, u: &[[T; 3]], led: &[[T; 3]]) -> Cause {
    let there: Vec<[T; 3]> = u.iter().zip(led).map(|(u, led)| std::array::from_fn(|i| u[i] + led[i])).collect();
    for u in [u, &there] {
        let (J, element) = system.elements.min_det_F(u);
        // NaN is no volume either.
        if !(J > T::default()) {
            return Cause::Inverted { element, J: J.as_f64() };
        }
    }
    Cause::Overflow
}
