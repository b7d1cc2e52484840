//! Contact in sweeps: each sweep ends with nodes put onto the planes that they are behind, with Coulomb's bound on the way along them.
//!
//! The multipliers λ = Δt² f of normal and friction forces are accumulated over the sweeps of a step, λ_n ≥ 0 and |λ_t| ≤ μ λ_n, so that
//! the sweeps converge to a step of implicit Euler with Signorini's and Coulomb's conditions: Macklin, Müller and Chentanez 2016,
//! section 6 (contact); the projection on Coulomb's disc is that of Jourdan, Alart and Jean, A Gauss–Seidel like algorithm to solve
//! frictional contact problems (1998).

use fem_scene::ContactPlane;
use fem_scene::simulation::History;
use nalgebra::Vector3;

use crate::forces::contact::planes::Planes;
use crate::history::{put, take};
use crate::number::Real;
use crate::vector::max_norm;

/// Distance from a plane at which a node rests, in lengths of the body and in rounding errors of its displacement.
const SKIN: f64 = 1e-9;
const ROUNDING: f64 = 32.0;

/// Most passes over the planes that end a step: a node in a corner takes several.
const PASSES: usize = 50;

/// The obstacles of a body, with what they add up in a step.
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
pub(super) struct ContactStep<'a, T> {
    /// Displacements at the start, m.
    pub start: &'a [[T; 3]],
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

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        self.planes.bytes() + size_of_val(&self.multipliers[..])
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

    /// Sets the multipliers to zero: a step starts.
    pub(super) fn begin_step(&mut self, dt2: f64) {
        self.multipliers.fill([0.0; 4]);
        self.dt2 = dt2;
    }

    /// Corrects the nodes that are behind a plane, or have been.
    pub(super) fn sweep<T: Real>(&mut self, step: ContactStep<T>, u: &mut [[T; 3]]) {
        self.pass(step, u);
    }

    /// Corrects nodes until none is behind a plane: the step ends.
    pub(super) fn end_step<T: Real>(&mut self, step: ContactStep<T>, u: &mut [[T; 3]]) {
        for _ in 0..PASSES {
            if !self.pass(step, u) {
                return;
            }
        }
    }

    /// Returns whether a node was behind a plane.
    fn pass<T: Real>(&mut self, step: ContactStep<T>, u: &mut [[T; 3]]) -> bool {
        let Self { planes, multipliers, length, .. } = self;
        let skin = SKIN * *length + ROUNDING * T::EPSILON.as_f64() * max_norm(u);
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
                correct(&planes.planes[plane], travel, gap, multiplier, (node, step), &mut u[node]);
            }
        }
        was_behind
    }

    /// Adds the multipliers of the last step that are not zero to a history.
    pub fn save(&self, history: &mut History) {
        put(history, "contact.projection_dt2", &[self.dt2]);
        let touching = self.multipliers.iter().enumerate().filter(|(_, multiplier)| **multiplier != [0.0; 4]);
        let numbers: Vec<f64> = touching.flat_map(|(place, m)| [place as f64, m[0], m[1], m[2], m[3]]).collect();
        put(history, "contact.projection", &numbers);
    }

    /// Takes over what [`save`](Self::save) has added.
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

/// Corrects one node that is `gap` from a plane which moves by `travel` in the step.
fn correct<T: Real>(
    &ContactPlane { normal, friction, .. }: &ContactPlane,
    travel: Vector3<f64>,
    gap: f64,
    multiplier: &mut [f64; 4],
    (node, step): (usize, ContactStep<T>),
    u: &mut [T; 3],
) {
    let w = Vector3::from(step.inverse_masses[node].map(|w| w.as_f64()));
    let of_normal = w.component_mul(&normal);
    let inverse_mass = of_normal.dot(&normal);
    // A node that cannot give way takes no part; the check of the state tells if it is behind the plane.
    if inverse_mass <= 1e-12 * w.amax() {
        return;
    }
    let mut place = Vector3::from(u.map(|u| u.as_f64()));
    let total = f64::max(0.0, multiplier[0] - gap / inverse_mass);
    place += of_normal * (total - multiplier[0]);
    multiplier[0] = total;
    if friction > 0.0 {
        let free = w.map(|w| if w > 0.0 { 1.0 } else { 0.0 });
        let moved = place - Vector3::from(step.start[node].map(|u| u.as_f64())) - travel;
        let slide = free.component_mul(&(moved - normal * normal.dot(&moved)));
        let before = Vector3::new(multiplier[1], multiplier[2], multiplier[3]);
        let trial = before - slide / w.amax();
        let (bound, size) = (friction * total, trial.norm());
        let along = if size > bound { trial * (bound / size) } else { trial };
        place += w.component_mul(&(along - before));
        [multiplier[1], multiplier[2], multiplier[3]] = along.into();
    }
    *u = [0, 1, 2].map(|i| T::of(place[i]));
}
