//! Friction below its transition speed: how long, and how far nodes have slid there.

use fem_model::simulation::History;

use crate::forces::contact::barrier::Barrier;
use crate::forces::contact::friction::{norm, slope_over_y, tangential};
use crate::forces::contact::planes::Planes;
use crate::model::state::State;
use fem_elements::history::{put, take};
use fem_elements::vector::triple;
use fem_solvers::Real;

/// Part of the steps with friction from which creep is told.
const MOST: f64 = 0.5;

/// Sliding below the transition speed since the start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Creep {
    /// Steps in which a rough plane has touched the body.
    steps: f64,
    /// Those in which most of the normal force was on nodes below the transition speed.
    creeping: f64,
    /// Sum over these of the mean sliding distance of these nodes, m.
    way: f64,
    /// Their time, s.
    time: f64,
    /// Sum over these of their friction as a part of Coulomb's.
    part: f64,
}

impl Creep {
    /// Adds a step between two states; sliding from ε_v (m/s) on has its full friction.
    pub(super) fn add<T: Real>(
        &mut self,
        (planes, barrier): (&Planes, &Barrier),
        transition_speed: f64,
        before: &State<T>,
        after: &State<T>,
    ) {
        let dt = after.time - before.time;
        let transition = transition_speed * dt;
        let (mut bounds, mut slow, mut way, mut friction) = (0.0, 0.0, 0.0, 0.0);
        for near in planes.near(&after.u, after.time, barrier.distance) {
            let plane = &planes.planes[near.plane];
            let bound = plane.friction * barrier.force(barrier.area(near.plane, near.node), near.gap);
            if bound > 0.0 {
                let moved = triple(|i| (after.u[near.node][i] - before.u[near.node][i]).as_f64());
                let slide = norm(tangential(plane, moved, [before.time, after.time]));
                bounds += bound;
                if slide < transition {
                    slow += bound;
                    way += bound * slide;
                    friction += bound * slide * slope_over_y(slide, transition);
                }
            }
        }
        if bounds > 0.0 {
            self.steps += 1.0;
            if slow > MOST * bounds {
                self.creeping += 1.0;
                self.way += way / slow;
                self.time += dt;
                self.part += friction / slow;
            }
        }
    }

    /// One line if most of the steps with friction have slid below the transition speed (m/s), farther in all than `distance`, m: a body
    /// that only sticks creeps less.
    pub(super) fn warning(&self, transition_speed: f64, distance: f64) -> Option<String> {
        let Self { steps, creeping, way, time, part } = *self;
        (creeping > MOST * steps && way > distance).then(|| {
            format!(
                "friction: in {creeping} of {steps} steps with contact the body slid below the transition speed of {transition_speed:.3e} m/s, \
                 by {way:.3e} m at {:.3e} m/s in the mean, with {:.0} % of Coulomb's friction; give a smaller contact.transition_speed \
                 unless that is meant",
                way / time,
                100.0 * part / creeping
            )
        })
    }

    pub(super) fn save(&self, history: &mut History) {
        put(history, "contact.creep", &[self.steps, self.creeping, self.way, self.time, self.part]);
    }

    pub(super) fn restore(&mut self, history: &History) -> Result<(), String> {
        let mut numbers = [0.0; 5];
        take(history, "contact.creep", &mut numbers)?;
        let [steps, creeping, way, time, part] = numbers;
        *self = Self { steps, creeping, way, time, part };
        Ok(())
    }
}
