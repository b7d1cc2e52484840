//! Coulomb friction as a potential of a step: Li et al., Incremental Potential Contact (2020), section 5.
//!
//! A node that slides by y (m) against a plane in a step of dt has the energy μ N f(y), which grows linearly beyond ε = ε_v dt and is
//! smooth below: below the transition speed ε_v friction is smaller than μ N, so that a body at rest on a slope creeps at less than ε_v.
//! The normal force N is kept fixed while Newton's method runs (lagged), and evaluated again until it no longer changes.

use fem_model::{Body, ContactPlane, ContactTreatment};

use super::barrier::Barrier;
use super::planes::Planes;
use super::start::Obstacles;
use crate::forces::{self, AddBlock, Energy, HessianKind, Moment, Potential};
use fem_elements::vector::triple;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "friction";

/// Forces that would displace the body in a step by less than this part of its length do not count as a change of the lag; their relative
/// change is that of rounding errors.
const RESOLUTION: f64 = 1e-6;

/// Friction between a body and its obstacles.
pub struct Friction<T> {
    planes: Planes,
    barrier: Barrier,
    /// ε_v, m/s.
    transition_speed: f64,
    /// ε, m: the sliding distance in a step from which friction has its full size.
    transition: f64,
    /// kg m
    mass_times_length: f64,
    /// Displacements at the start of the step, m.
    start: Vec<[T; 3]>,
    /// Times of its start and end, s.
    times: [f64; 2],
    /// The nodes that touch a plane with friction.
    lagged: Vec<Lagged>,
    /// Normal forces before the last update.
    previous: Vec<Lagged>,
}

/// A node that touches a plane with friction.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lagged {
    plane: usize,
    node: usize,
    /// Normal force times the coefficient of friction, N.
    bound: f64,
}

/// Friction of a body with rough obstacles, for implicit methods.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let contact = body.contact.as_ref().filter(|contact| contact.treatment == ContactTreatment::Barrier)?;
    if contact.planes.iter().all(|plane| plane.friction == 0.0) {
        return None;
    }
    let nodes = body.shape.mesh.vertices().len();
    let Obstacles { planes, barrier, .. } = Obstacles::new(body, numbering)?;
    Some(Box::new(Friction {
        planes,
        barrier,
        transition_speed: contact.transition_speed,
        transition: 0.0,
        mass_times_length: mass_times_length(body),
        start: vec![[T::default(); 3]; nodes],
        times: [0.0; 2],
        lagged: Vec::new(),
        previous: Vec::new(),
    }))
}

impl<T: Real> Friction<T> {
    /// Evaluates the normal forces at displacements and a time, s.
    fn evaluate(&mut self, u: &[[T; 3]], time: f64) {
        let Self { planes, barrier, lagged, .. } = self;
        lagged.clear();
        for near in planes.near(u, time, barrier.distance) {
            let normal_force = barrier.force(barrier.area(near.plane, near.node), near.gap);
            let bound = planes.planes[near.plane].friction * normal_force;
            if bound > 0.0 {
                lagged.push(Lagged { plane: near.plane, node: near.node, bound });
            }
        }
    }

    /// The touching nodes, each with its sliding in the step, m.
    fn sliding(&self, u: &[[T; 3]]) -> impl Iterator<Item = (&Lagged, [f64; 3])> {
        let slide = move |plane: usize, node: usize| {
            let moved: [f64; 3] = triple(|i| (u[node][i] - self.start[node][i]).as_f64());
            tangential(&self.planes.planes[plane], moved, self.times)
        };
        self.lagged.iter().map(move |lagged| (lagged, slide(lagged.plane, lagged.node)))
    }

    /// The Hessian of μ N f(y), N/m: f'(y)/y (1 − n nᵀ − t tᵀ) + f''(y) t tᵀ with the direction t of sliding.
    fn block(&self, lagged: &Lagged, slide: [f64; 3]) -> [[f64; 3]; 3] {
        let (y, n) = (norm(slide), self.planes.planes[lagged.plane].normal);
        let across = slope_over_y(y, self.transition);
        // Along the direction of sliding the slope no longer grows beyond ε.
        let along = if y > 0.0 { (curvature(y, self.transition) - across) / (y * y) } else { 0.0 };
        triple(|i| {
            triple(|j| {
                let one = if i == j { 1.0 } else { 0.0 };
                lagged.bound * (across * (one - n[i] * n[j]) + along * slide[i] * slide[j])
            })
        })
    }
}

impl<T: Real> Potential<T> for Friction<T> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let speed = self.transition_speed;
        format!("[[planes]] with friction: Coulomb's, smoothed below {speed:.3e} m/s, with lagged normal forces")
    }

    fn bytes(&self) -> usize {
        self.planes.bytes() + self.barrier.bytes() + size_of_val(&self.start[..])
    }

    fn begin_step(&mut self, u: &[[T; 3]], start: Moment, dt: f64) {
        self.start.copy_from_slice(u);
        self.barrier.begin_step(u);
        self.times = [start.time, start.time + dt];
        self.transition = self.transition_speed * dt;
        self.evaluate(u, start.time);
    }

    fn energy(&self, u: &[[T; 3]], _: Moment) -> Energy {
        let energy = |bound: f64, slide| Energy::of(bound * smoothed(norm(slide), self.transition));
        self.sliding(u).map(|(lagged, slide)| energy(lagged.bound, slide)).sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], _: Moment, gradient: &mut [[T; 3]]) {
        for (lagged, slide) in self.sliding(u) {
            let factor = lagged.bound * slope_over_y(norm(slide), self.transition);
            for i in 0..3 {
                gradient[lagged.node][i] += T::of(factor * slide[i]);
            }
        }
    }

    fn hessian(&self, u: &[[T; 3]], _: Moment, _: HessianKind, add: &mut AddBlock<T>) {
        for (lagged, slide) in self.sliding(u) {
            add(lagged.node, lagged.node, self.block(lagged, slide).map(|row| row.map(T::of)));
        }
    }

    fn lagged(&self) -> Option<&dyn forces::Lagged<T>> {
        Some(self)
    }

    fn lagged_mut(&mut self) -> Option<&mut dyn forces::Lagged<T>> {
        Some(self)
    }
}

impl<T: Real> forces::Lagged<T> for Friction<T> {
    fn update(&mut self, u: &[[T; 3]], relaxation: f64) -> f64 {
        std::mem::swap(&mut self.lagged, &mut self.previous);
        self.evaluate(u, self.times[1]);
        let dt = self.times[1] - self.times[0];
        let change = change(&self.previous, &self.lagged, RESOLUTION * self.mass_times_length / (dt * dt));
        if relaxation < 1.0 {
            relax(&self.previous, &mut self.lagged, relaxation);
        }
        change
    }
}

fn mass_times_length(body: &Body) -> f64 {
    let volume: f64 = body.shape.mesh.volumes().iter().sum();
    body.material.density * volume * body.shape.mesh.length()
}

/// The part along a plane of a displacement in a step, relative to the plane's own between these times (s), m.
pub fn tangential(plane: &ContactPlane, moved: [f64; 3], times: [f64; 2]) -> [f64; 3] {
    let relative = nalgebra::Vector3::from(moved) - (plane.displacement(times[1]) - plane.displacement(times[0]));
    (relative - plane.normal * plane.normal.dot(&relative)).into()
}

/// f(y) for y ≥ 0, with f(0) = 0: y²/ε − y³/(3ε²) below ε, y − ε/3 beyond.
fn smoothed(y: f64, transition: f64) -> f64 {
    let s = y / transition;
    if s < 1.0 { y * s * (1.0 - s / 3.0) } else { y - transition / 3.0 }
}

/// f'(y)/y, 1/m: f' grows from 0 to 1 at ε.
pub fn slope_over_y(y: f64, transition: f64) -> f64 {
    let s = y / transition;
    if s < 1.0 { (2.0 - s) / transition } else { 1.0 / y }
}

/// f''(y), 1/m.
fn curvature(y: f64, transition: f64) -> f64 {
    let s = y / transition;
    if s < 1.0 { 2.0 * (1.0 - s) / transition } else { 0.0 }
}

/// Length of a vector.
pub fn norm(x: [f64; 3]) -> f64 {
    x[0].hypot(x[1]).hypot(x[2])
}

/// Sum of the changes of the bounds over the sum of the bounds, which counts as no less than `least`. Both lists are ordered by plane and
/// node.
fn change(before: &[Lagged], now: &[Lagged], least: f64) -> f64 {
    let key = |lagged: &Lagged| (lagged.plane, lagged.node);
    let sum = |list: &[Lagged]| list.iter().map(|lagged| lagged.bound).sum::<f64>();
    let size = least.max(sum(before)).max(sum(now));
    let (mut before, mut changes) = (before.iter().peekable(), 0.0);
    for lagged in now {
        while let Some(gone) = before.next_if(|before| key(before) < key(lagged)) {
            changes += gone.bound;
        }
        let earlier = before.next_if(|before| key(before) == key(lagged)).map_or(0.0, |earlier| earlier.bound);
        changes += (lagged.bound - earlier).abs();
    }
    changes += before.map(|gone| gone.bound).sum::<f64>();
    if changes > 0.0 { changes / size } else { 0.0 }
}

/// Takes over a part of the change from `before` in `now`.
fn relax(before: &[Lagged], now: &mut Vec<Lagged>, part: f64) {
    now.iter_mut().for_each(|lagged| lagged.bound *= part);
    for lagged in before {
        let (key, rest) = ((lagged.plane, lagged.node), (1.0 - part) * lagged.bound);
        match now.binary_search_by_key(&key, |lagged| (lagged.plane, lagged.node)) {
            Ok(place) => now[place].bound += rest,
            Err(place) => now.insert(place, Lagged { bound: rest, ..*lagged }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Lagged, change, curvature, relax, slope_over_y, smoothed};

    #[test]
    fn the_force_of_friction_is_the_slope_of_its_potential_and_grows_to_one_at_the_transition() {
        let transition = 0.2;
        for y in [1e-3, 0.05, 0.19, 0.21, 3.0] {
            let h = 1e-6 * y;
            let slope = (smoothed(y + h, transition) - smoothed(y - h, transition)) / (2.0 * h);
            assert!((y * slope_over_y(y, transition) - slope).abs() < 1e-8, "{y}");
            let force = |y: f64| y * slope_over_y(y, transition);
            assert!((curvature(y, transition) - (force(y + h) - force(y - h)) / (2.0 * h)).abs() < 1e-6, "{y}");
        }
        assert_eq!((smoothed(0.0, transition), 5.0 * slope_over_y(5.0, transition)), (0.0, 1.0));
        assert!(slope_over_y(0.0, transition) == 10.0 && smoothed(transition, transition) > 0.0);
    }

    #[test]
    fn the_change_of_the_lag_counts_nodes_that_come_and_go() {
        let lagged = |node: usize, bound: f64| Lagged { plane: 0, node, bound };
        assert_eq!(change(&[], &[], 0.0), 0.0);
        assert_eq!(change(&[lagged(1, 2.0), lagged(4, 1.0)], &[lagged(1, 2.5), lagged(7, 1.5)], 0.0), 0.75);
        assert_eq!(change(&[lagged(1, 2.0)], &[lagged(1, 2.0)], 0.0), 0.0);
        assert_eq!(change(&[lagged(1, 2.0)], &[], 0.0), 1.0);
        assert_eq!(change(&[lagged(1, 2.0)], &[], 8.0), 0.25);
        let mut relaxed = vec![lagged(1, 4.0), lagged(7, 1.0)];
        relax(&[lagged(1, 2.0), lagged(4, 3.0)], &mut relaxed, 0.25);
        assert_eq!(relaxed, [lagged(1, 2.5), lagged(4, 2.25), lagged(7, 0.25)]);
    }
}
