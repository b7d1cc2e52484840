//! Prescribed motions within a step of an explicit method: displacements, velocities and accelerations of the constrained degrees of
//! freedom.

use crate::model::state::State;
use crate::model::system::System;
use fem_solvers::Real;

/// Largest change of displacements and velocities, in units of the machine epsilon, that counts as rounding error and not as a jump.
const ROUNDING: f64 = 64.0;

/// The constrained degrees of freedom of a body during one step.
///
/// They follow the motion itself, with its derivatives in closed form. If they differ from it at the start of the step (a motion that
/// applies in full from the first step on, a curve that jumps), the difference decreases to zero at constant speed until its end.
#[derive(Clone, Debug, Default)]
pub struct PrescribedMotion<T> {
    /// Velocities, m/s, and accelerations, m/s², of the constrained degrees of freedom at the last stage; zero elsewhere. Empty without a
    /// prescribed motion.
    pub velocity: Vec<[T; 3]>,
    /// See `velocity`.
    pub acceleration: Vec<[T; 3]>,
    /// Distance from the motion at the start of the step, m.
    gap: Vec<[T; 3]>,
    /// Start and end of the step, s.
    step: [f64; 2],
    /// A bound of the rounding errors of the velocities, m/s.
    round_off: f64,
}

impl<T: Real> PrescribedMotion<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let mut new = Self::default();
        if system.dirichlet.has_motion() {
            new.make_room(system.nodes());
        }
        new
    }

    fn make_room(&mut self, nodes: usize) {
        for vector in [&mut self.velocity, &mut self.acceleration, &mut self.gap] {
            vector.resize(nodes, [T::default(); 3]);
            // Nodes that have become free.
            vector.fill([T::default(); 3]);
        }
    }

    /// Starts a step of `dt` seconds from a state.
    pub fn begin(&mut self, system: &System<T>, state: &State<T>, dt: f64) {
        // A reset can bring back a motion that had ended when the vectors were allocated.
        self.make_room(system.nodes());
        self.step = [state.time, state.time + dt];
        let mut fastest: f64 = 0.0;
        for (condition, motion) in system.dirichlet.motions() {
            let [fraction, ..] = motion.fraction_in_step(self.step, 0.0);
            for &node in &condition.nodes {
                let rest = &system.rest[node];
                let place = motion.position(rest, fraction) - rest;
                fastest = fastest.max(motion.derivatives(rest, fraction)[0].amax() / dt);
                let round_off = ROUNDING * (T::EPSILON.as_f64() * place.amax() + f64::EPSILON * rest.amax());
                for i in (0..3).filter(|&i| condition.components[i]) {
                    let gap = state.u[node][i].as_f64() - place[i];
                    self.gap[node][i] = T::of(if gap.abs() > round_off { gap } else { 0.0 });
                }
            }
        }
        self.round_off = ROUNDING * f64::EPSILON * fastest;
    }

    /// Sets constrained displacements and velocities to those at a part of the step: 0 is its start, 1 its end.
    pub fn place(&mut self, system: &System<T>, part: f64, u: &mut [[T; 3]], v: &mut [[T; 3]]) {
        let Self { velocity, acceleration, gap, step, .. } = self;
        let over_dt = 1.0 / (step[1] - step[0]);
        for (condition, motion) in system.dirichlet.motions() {
            let [fraction, rate, change] = motion.fraction_in_step(*step, part);
            for &node in &condition.nodes {
                let rest = &system.rest[node];
                let place = motion.position(rest, fraction) - rest;
                let [first, second] = motion.derivatives(rest, fraction);
                for i in (0..3).filter(|&i| condition.components[i]) {
                    let gap = gap[node][i].as_f64();
                    u[node][i] = T::of(place[i] + (1.0 - part) * gap);
                    velocity[node][i] = T::of(rate * first[i] - over_dt * gap);
                    v[node][i] = velocity[node][i];
                    acceleration[node][i] = T::of(change * first[i] + rate * rate * second[i]);
                }
            }
        }
    }

    /// Starts the velocities of the step in `v`. Writes their change, m/s, into `jump`, which is zero at free degrees of freedom. Returns
    /// whether it is more than rounding errors: at a kink of the motion, as where it starts.
    pub fn start(&mut self, system: &System<T>, state: &mut State<T>, jump: &mut [[T; 3]]) -> bool {
        jump.copy_from_slice(&state.v);
        self.place(system, 0.0, &mut state.u, &mut state.v);
        let (mut largest, mut fastest): (f64, f64) = (0.0, 0.0);
        for (jump, v) in jump.as_flattened_mut().iter_mut().zip(state.v.as_flattened()) {
            *jump = *v - *jump;
            largest = largest.max(jump.as_f64().abs());
            fastest = fastest.max(v.as_f64().abs());
        }
        largest > self.round_off + ROUNDING * T::EPSILON.as_f64() * fastest
    }
}
