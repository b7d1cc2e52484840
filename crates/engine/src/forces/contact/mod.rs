//! Contact with planes: a barrier energy, and a friction potential beside it, for implicit methods. Explicit methods use
//! impulses instead.

pub mod areas;
pub mod barrier;
pub mod friction;
pub mod planes;
pub mod start;

use fem_model::{Body, ContactTreatment};

use super::{AddBlock, Energy, HessianKind, Moment, Potential};
use barrier::Barrier;
use fem_elements::vector::triple;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;
use planes::Planes;
use start::Obstacles;

/// Key in the statistics.
pub const NAME: &str = "contact";

/// The barrier between a body and its obstacles, as a potential.
pub struct Contact {
    planes: Planes,
    barrier: Barrier,
}

/// The barrier of a body with obstacles, for implicit methods.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    body.contact.as_ref().filter(|contact| contact.treatment == ContactTreatment::Barrier)?;
    let Obstacles { planes, barrier, .. } = Obstacles::new(body, numbering)?;
    Some(Box::new(Contact { planes, barrier }))
}

/// Distances to which an infeasible node is moved, as parts of the activation distance and of its distance at the start.
const FROM_AFAR: f64 = 0.5;
const FROM_NEAR: f64 = 0.1;

/// Largest number of loops over the planes that move a node out of all of them.
const PASSES: usize = 50;

impl Contact {
    /// The nodes within the activation distance, each with its area.
    fn active<T: Real>(&self, u: &[[T; 3]], time: f64) -> impl Iterator<Item = (planes::Near, f64)> {
        let near = self.planes.near(u, time, self.barrier.distance);
        near.map(move |near| (near, self.barrier.area(near.plane, near.node))).filter(|(_, area)| *area > 0.0)
    }

    fn normal(&self, plane: usize) -> [f64; 3] {
        self.planes.planes[plane].normal.into()
    }
}

impl<T: Real> Potential<T> for Contact {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let Barrier { distance, stiffness, .. } = &self.barrier;
        let planes = self.planes.planes.len();
        format!("[[planes]]: {planes}, with a barrier of {stiffness:.3e} Pa below {distance:.3e} m")
    }

    fn bytes(&self) -> usize {
        self.planes.bytes() + self.barrier.bytes()
    }

    fn begin_step(&mut self, u: &[[T; 3]], _: Moment, _: f64) {
        self.barrier.begin_step(u);
    }

    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        self.active(u, moment.time).map(|(near, area)| Energy::of(self.barrier.energy(area, near.gap))).sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        for (near, area) in self.active(u, moment.time) {
            let (force, n) = (self.barrier.force(area, near.gap), self.normal(near.plane));
            for i in 0..3 {
                gradient[near.node][i] -= T::of(force * n[i]);
            }
        }
    }

    fn hessian(&self, u: &[[T; 3]], moment: Moment, _: HessianKind, add: &mut AddBlock<T>) {
        for (near, area) in self.active(u, moment.time) {
            let (k, n) = (self.barrier.curvature(area, near.gap), self.normal(near.plane));
            add(near.node, near.node, triple(|i| triple(|j| T::of(k * n[i] * n[j]))));
        }
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let Barrier { distance, stiffness, .. } = &self.barrier;
        let fits =
            fem_elements::number::is_positive(T::of(*distance)) && fem_elements::number::is_positive(T::of(*stiffness));
        (!fits).then_some(("contact", "a stiffness of the barrier"))
    }

    fn barrier(&self) -> Option<&dyn super::Barrier<T>> {
        Some(self)
    }
}

impl<T: Real> super::Barrier<T> for Contact {
    fn scale(&self) -> f64 {
        self.barrier.distance
    }

    fn largest_step(&self, u: &[[T; 3]], moment: Moment, direction: &[[T; 3]]) -> f64 {
        let of_plane = |plane: usize| {
            let n = self.normal(plane);
            let nodes = self.planes.gaps(plane, u, moment.time).zip(direction).enumerate();
            let free = nodes.filter(move |(node, _)| self.barrier.area(plane, *node) > 0.0);
            let steps = free.map(move |(_, (gap, direction))| (gap, -planes::along(n, direction)));
            steps.filter(|(_, approach)| *approach > 0.0).map(|(gap, approach)| gap / approach)
        };
        (0..self.planes.planes.len()).flat_map(of_plane).fold(f64::INFINITY, f64::min)
    }

    /// Moves nodes that would be behind a plane, or much nearer to it than at the start, along its normal.
    fn make_feasible(&self, start: &[[T; 3]], end: Moment, increment: &mut [[T; 3]]) -> bool {
        let mut has_changed = false;
        for _ in 0..PASSES {
            let mut has_moved = false;
            for plane in 0..self.planes.planes.len() {
                let n = self.normal(plane);
                for (node, before) in self.planes.gaps(plane, start, end.time).enumerate() {
                    let now = before + planes::along(n, &increment[node]);
                    let is_near = before > 0.0 && before < self.barrier.distance;
                    let least = if is_near { FROM_NEAR * before } else { FROM_AFAR * self.barrier.distance };
                    // Rounding errors must not cause another pass.
                    if now < 0.999 * least && self.barrier.area(plane, node) > 0.0 {
                        for i in 0..3 {
                            increment[node][i] += T::of((least - now) * n[i]);
                        }
                        has_moved = true;
                    }
                }
            }
            has_changed |= has_moved;
            if !has_moved {
                break;
            }
        }
        has_changed
    }
}
