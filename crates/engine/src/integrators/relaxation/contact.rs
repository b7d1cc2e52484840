//! Contact in sweeps: each sweep ends with a projection of nodes behind a plane onto it, with Coulomb's bound on their sliding.
//!
//! The multipliers λ = Δt² f of normal and friction forces are accumulated over the sweeps of a step, λ_n ≥ 0 and |λ_t| ≤ μ λ_n, so that
//! the sweeps converge to a step of implicit Euler with Signorini's and Coulomb's conditions: Macklin, Müller and Chentanez 2016,
//! section 6 (contact); the projection on Coulomb's disc is that of Jourdan, Alart and Jean, A Gauss–Seidel like algorithm to solve
//! frictional contact problems (1998).

use fem_model::ContactPlane;
use fem_model::simulation::History;
use nalgebra::{Matrix3, Vector3};

use crate::forces::contact::planes::Planes;
use fem_elements::history::{put, take};
use fem_elements::vector::max_norm;
use fem_solvers::Real;

/// Distance from a plane at which a node rests, in lengths of the body and in rounding errors of its displacement.
const SKIN: f64 = 1e-9;
const ROUNDING: f64 = 32.0;

/// Largest number of loops over the planes at the end of a step: a node in a corner takes several.
const PASSES: usize = 50;

/// The obstacles of a body, with the multipliers of a step.
pub struct PlaneContacts {
    planes: Planes,
    /// m
    length: f64,
    /// Δt² times the force on each node, kg m: along the normal, and the vector along the plane. Those of the first plane come first.
    multipliers: Vec<[f64; 4]>,
    /// s², of the last step.
    dt2: f64,
}

/// A step for its contacts.
#[derive(Clone, Copy)]
pub struct ContactStep<'a, T> {
    /// Displacements at the start, m.
    pub start: &'a [[T; 3]],
    /// 1/kg, zero in constrained directions.
    pub inverse_masses: &'a [[T; 3]],
    /// Start and end, s.
    pub times: [f64; 2],
}

impl PlaneContacts {
    /// The contacts with these planes of a body of a length, m.
    pub fn new(planes: Planes, length: f64) -> Self {
        let count = planes.planes.len() * planes.nodes();
        Self { planes, length, multipliers: vec![[0.0; 4]; count], dt2: 1.0 }
    }

    /// The force of each plane on each node in the last step that is not zero, N.
    pub fn forces(&self) -> impl Iterator<Item = (usize, usize, Vector3<f64>)> {
        let nodes = self.planes.nodes();
        let touching = self.multipliers.iter().enumerate().filter(|(_, multiplier)| multiplier[0] > 0.0);
        touching.map(move |(place, &[normal, x, y, z])| {
            let plane = place / nodes;
            let total = self.planes.planes[plane].normal * normal + Vector3::new(x, y, z);
            (plane, place % nodes, total / self.dt2)
        })
    }

    /// Work on the body in the last step, of `dt` seconds from `time` on, of planes that move, J.
    pub fn work(&self, time: f64, dt: f64) -> f64 {
        let travel = |plane: &ContactPlane| plane.displacement(time + dt) - plane.displacement(time);
        let travels: Vec<_> = self.planes.planes.iter().map(travel).collect();
        if travels.iter().all(|travel| *travel == Vector3::zeros()) {
            return 0.0;
        }
        self.forces().map(|(plane, _, force)| force.dot(&travels[plane])).sum()
    }

    /// Sets the multipliers to zero: a step starts.
    pub fn begin_step(&mut self, dt2: f64) {
        self.multipliers.fill([0.0; 4]);
        self.dt2 = dt2;
    }

    /// Corrects the nodes that are behind a plane, or have been.
    pub fn sweep<T: Real>(&mut self, step: ContactStep<T>, u: &mut [[T; 3]]) {
        self.pass(step, u);
    }

    /// Corrects nodes until none is behind a plane: the step ends.
    pub fn end_step<T: Real>(&mut self, step: ContactStep<T>, u: &mut [[T; 3]]) {
        for _ in 0..PASSES {
            if !self.pass(step, u) {
                return;
            }
        }
    }

    /// Returns whether a node was behind a plane.
    fn pass<T: Real>(&mut self, step: ContactStep<T>, u: &mut [[T; 3]]) -> bool {
        let Self { planes, multipliers, length, .. } = self;
        let skin = skin(*length, u);
        let (mut was_behind, nodes) = (false, planes.nodes());
        for (plane, of_plane) in multipliers.chunks_exact_mut(nodes.max(1)).enumerate() {
            let travel =
                planes.planes[plane].displacement(step.times[1]) - planes.planes[plane].displacement(step.times[0]);
            for (node, multiplier) in of_plane.iter_mut().enumerate() {
                let gap = planes.gap(plane, node, &u[node], step.times[1]) - skin;
                if gap >= 0.0 && multiplier[0] == 0.0 {
                    continue;
                }
                was_behind |= gap < -0.5 * skin;
                let inverse = Matrix3::from_diagonal(&step.inverse_masses[node].map(|w| w.as_f64()).into());
                correct(&planes.planes[plane], travel, gap, multiplier, &inverse, &step.start[node], &mut u[node]);
            }
        }
        was_behind
    }

    /// Distance from a plane at which a node rests, m.
    pub fn skin<T: Real>(&self, u: &[[T; 3]]) -> f64 {
        skin(self.length, u)
    }

    /// Returns true if a plane exerts a force on a node.
    pub fn touches(&self, node: usize) -> bool {
        self.multipliers.iter().skip(node).step_by(self.planes.nodes().max(1)).any(|multiplier| multiplier[0] > 0.0)
    }

    /// The force of all planes on a node, N.
    pub fn force_on(&self, node: usize) -> Vector3<f64> {
        let force = |plane: usize| {
            let [normal, x, y, z] = self.multipliers[plane * self.planes.nodes() + node];
            (self.planes.planes[plane].normal * normal + Vector3::new(x, y, z)) / self.dt2
        };
        (0..self.planes.planes.len()).map(force).sum()
    }

    /// Returns true if a node may move to `free`: it is in front of all planes there, and no plane exerts a force on it.
    pub fn is_free<T: Real>(&self, node: usize, step: ContactStep<T>, skin: f64, free: &[T; 3]) -> bool {
        let count = self.planes.nodes();
        (0..self.planes.planes.len()).all(|plane| {
            self.multipliers[plane * count + node] == [0.0; 4]
                && self.planes.gap(plane, node, free, step.times[1]) >= skin
        })
    }

    /// Returns the displacement of a node whose Newton step would end at `free`, so that its contact forces satisfy Signorini's and
    /// Coulomb's conditions. `inverse` is the inverse of its block of the Hessian, m/N.
    pub fn settle<T: Real>(
        &mut self,
        node: usize,
        inverse: &Matrix3<f64>,
        step: ContactStep<T>,
        skin: f64,
        free: [T; 3],
    ) -> [T; 3] {
        // The iteration starts from the forces of the previous sweep, so that the limit of the sweeps does not depend on the number of passes.
        let moved = inverse * self.force_on(node);
        let mut u = [0, 1, 2].map(|i| T::of(free[i].as_f64() + moved[i]));
        let Self { planes, multipliers, dt2, .. } = self;
        let (count, inverse) = (planes.nodes(), inverse / *dt2);
        for _ in 0..PASSES {
            let before = u;
            for (plane, obstacle) in planes.planes.iter().enumerate() {
                let travel = obstacle.displacement(step.times[1]) - obstacle.displacement(step.times[0]);
                let gap = planes.gap(plane, node, &u, step.times[1]) - skin;
                let multiplier = &mut multipliers[plane * count + node];
                correct(obstacle, travel, gap, multiplier, &inverse, &step.start[node], &mut u);
            }
            if max_norm(&[[0, 1, 2].map(|i| u[i] - before[i])]) <= 1e-3 * skin {
                break;
            }
        }
        u
    }

    /// Adds the multipliers of the last step that are not zero to a history.
    pub fn save(&self, history: &mut History) {
        put(history, "contact.projection_dt2", &[self.dt2]);
        let touching = self.multipliers.iter().enumerate().filter(|(_, multiplier)| **multiplier != [0.0; 4]);
        let numbers: Vec<f64> = touching.flat_map(|(place, m)| [place as f64, m[0], m[1], m[2], m[3]]).collect();
        put(history, "contact.projection", &numbers);
    }

    /// Restores the multipliers that [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        take(history, "contact.projection_dt2", std::slice::from_mut(&mut self.dt2))?;
        self.multipliers.fill([0.0; 4]);
        let (numbers, _) = history.get("contact.projection")?.as_chunks::<5>();
        for &[place, normal, x, y, z] in numbers {
            let multiplier = self.multipliers.get_mut(place as usize);
            let multiplier =
                multiplier.ok_or("its `contact.projection` names a node or a plane that the scene does not have")?;
            *multiplier = [normal, x, y, z];
        }
        Ok(())
    }
}

/// Distance from a plane at which a node of a body of a length (m) rests, m.
fn skin<T: Real>(length: f64, u: &[[T; 3]]) -> f64 {
    SKIN * length + ROUNDING * T::EPSILON.as_f64() * max_norm(u)
}

/// Corrects one node that is `gap` from a plane which moves by `travel` in the step. A unit of a multiplier moves the node by `inverse`.
fn correct<T: Real>(
    &ContactPlane { normal, friction, .. }: &ContactPlane,
    travel: Vector3<f64>,
    gap: f64,
    multiplier: &mut [f64; 4],
    inverse: &Matrix3<f64>,
    start: &[T; 3],
    u: &mut [T; 3],
) {
    let of_normal = inverse * normal;
    let along_normal = of_normal.dot(&normal);
    let largest = inverse.diagonal().amax();
    // A node that cannot move along the normal is skipped; the check of the state finds it if it is behind the plane.
    if along_normal <= 1e-12 * largest {
        return;
    }
    let mut place = Vector3::from(u.map(|u| u.as_f64()));
    let total = f64::max(0.0, multiplier[0] - gap / along_normal);
    place += of_normal * (total - multiplier[0]);
    multiplier[0] = total;
    if friction > 0.0 {
        let free = inverse.diagonal().map(|w| if w > 0.0 { 1.0 } else { 0.0 });
        let moved = place - Vector3::from(start.map(|u| u.as_f64())) - travel;
        let slide = free.component_mul(&(moved - normal * normal.dot(&moved)));
        let before = Vector3::new(multiplier[1], multiplier[2], multiplier[3]);
        // The largest eigenvalue is at most the norm.
        let is_diagonal = inverse[(0, 1)] == 0.0 && inverse[(0, 2)] == 0.0 && inverse[(1, 2)] == 0.0;
        let trial = before - slide / if is_diagonal { largest } else { inverse.norm() };
        let (bound, size) = (friction * total, trial.norm());
        let along = if size > bound { trial * (bound / size) } else { trial };
        place += inverse * (along - before);
        [multiplier[1], multiplier[2], multiplier[3]] = along.into();
    }
    *u = [0, 1, 2].map(|i| T::of(place[i]));
}
