//! Contact in explicit methods: impulses at the end of a step stop nodes that would enter an obstacle, Moreau, Unilateral Contact and
//! Dry Friction in Finite Freedom Dynamics (1988).
//!
//! A node that touches a plane loses its normal velocity towards it (inelastic), and as much of its tangential velocity as Coulomb's
//! bound μ P allows for the normal impulse P. So friction depends on the impulses in a time, and not on the number of steps. Velocities
//! change by impulses alone, which therefore add up to the change of momentum; positions are projected onto the plane. An impact is of
//! first order in the time step, whatever the method; a body that rests or slides keeps the method's order.

use fem_model::simulation::History;
use fem_model::{ContactPlane, ContactTreatment, Integrator as IntegratorKind};
use nalgebra::Vector3;

use crate::forces::contact::planes::{Near, Planes};
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::history::put;
use fem_elements::vector::triple;
use fem_solvers::Real;

/// Distance from a plane at which a node rests, in lengths of the body and in rounding errors of its displacement.
const SKIN: f64 = 1e-9;
const ROUNDING: f64 = 32.0;

/// Number of these distances within which a node touches the plane.
const TOUCHING: f64 = 1.5;

/// Largest number of loops over the planes that move a node out of all of them, and that stop it in a corner between them.
const PASSES: usize = 50;

/// Change of an impulse, in rounding errors of the largest, that needs no further pass.
const CONVERGED: f64 = 16.0;

/// The impulses of the last step.
pub struct Impulses<T> {
    planes: Planes,
    /// kg
    masses: Vec<T>,
    /// m
    length: f64,
    impulses: Vec<Impulse>,
    /// Number of those that were found first, which are ordered by plane and node.
    ordered: usize,
    /// Nodes near a plane.
    near: Vec<Near>,
}

/// The impulse of a plane on a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulse {
    /// Number of the plane.
    pub plane: usize,
    /// The engine's number of the node.
    pub node: usize,
    /// Along the normal, N s.
    pub normal: f64,
    /// Along the plane, N s.
    pub tangential: Vector3<f64>,
}

impl<T: Real> Impulses<T> {
    /// The impulses of a body with these obstacles; `None` if the method has a barrier instead.
    pub fn new(planes: Planes, treatment: ContactTreatment, system: &mut System<T>) -> Option<Self> {
        if treatment != ContactTreatment::Impulses {
            return None;
        }
        system.contact_force = vec![[T::default(); 3]; system.nodes()];
        Some(Self {
            planes,
            masses: system.mass.row_sums(),
            length: system.length,
            impulses: Vec::new(),
            ordered: 0,
            near: Vec::new(),
        })
    }

    /// Corrects the state at the end of a step from `before` that lasts `dt` seconds. Returns whether a node touches a plane, or did
    /// before.
    ///
    /// During a step the contact impulses of the previous step are applied as a force, so that its stages have the velocities of nodes at
    /// rest. This function removes them and applies the impulses of this step.
    pub fn apply(
        &mut self,
        system: &mut System<T>,
        before: &State<T>,
        state: &mut State<T>,
        (kind, dt): (IntegratorKind, f64),
    ) -> bool {
        let times = [before.time, before.time + dt];
        for impulse in &self.impulses {
            let total = impulse.total(self.planes.planes[impulse.plane].normal);
            let change = free(system, impulse.node).component_mul(&total) / -self.masses[impulse.node].as_f64();
            add(&mut state.v[impulse.node], change);
            add(&mut state.u[impulse.node], change * (share(kind) * dt));
        }
        let had_contact = !self.impulses.is_empty();
        self.impulses.clear();
        self.ordered = 0;
        self.move_out(system, &mut state.u, times[1]);
        if self.impulses.is_empty() {
            self.write_forces(system, dt);
            return had_contact;
        }
        let mut largest: f64 = 0.0;
        for _ in 0..PASSES {
            let mut change: f64 = 0.0;
            for impulse in &mut self.impulses {
                let plane = &self.planes.planes[impulse.plane];
                let node = Node { mass: self.masses[impulse.node].as_f64(), free: free(system, impulse.node) };
                let v = &mut state.v[impulse.node];
                change = change.max(node.stop(plane, plane.mean_velocity(times), impulse, v));
                largest = largest.max(impulse.normal.abs());
            }
            if change <= CONVERGED * T::EPSILON.as_f64() * largest {
                break;
            }
        }
        for impulse in &self.impulses {
            let mass = self.masses[impulse.node].as_f64();
            let shift = free(system, impulse.node).component_mul(&impulse.tangential) * (share(kind) * dt / mass);
            add(&mut state.u[impulse.node], shift);
        }
        self.move_out(system, &mut state.u, times[1]);
        self.write_forces(system, dt);
        true
    }

    /// Makes the impulses the forces of the next step, which lasts `dt` seconds.
    pub fn write_forces(&self, system: &mut System<T>, dt: f64) {
        system.contact_force.fill([T::default(); 3]);
        for impulse in &self.impulses {
            add(&mut system.contact_force[impulse.node], impulse.total(self.planes.planes[impulse.plane].normal) / dt);
        }
    }

    /// Puts nodes behind a plane onto it, and adds those that touch one to the list.
    fn move_out(&mut self, system: &System<T>, u: &mut [[T; 3]], time: f64) {
        let Self { planes, impulses, ordered, near, length, .. } = self;
        // A bound for all nodes, so that most of them cost no more than their distance.
        let round_off = ROUNDING * T::EPSILON.as_f64();
        for _ in 0..PASSES {
            let mut has_moved = false;
            let farthest = TOUCHING * (SKIN * *length + round_off * fem_elements::vector::max_norm(u));
            near.clear();
            near.extend(planes.near(u, time, farthest));
            for &Near { plane, node, .. } in &*near {
                let n = planes.planes[plane].normal;
                let free_normal = free(system, node).component_mul(&n);
                // A node that cannot move along the normal is skipped; the check of the state finds it if it is behind the plane.
                if free_normal.norm_squared() < 1e-12 {
                    continue;
                }
                let skin = SKIN * *length + round_off * fem_elements::vector::max_norm(&[u[node]]);
                let gap = planes.gap(plane, node, &u[node], time);
                if gap < TOUCHING * skin && !is_listed(impulses, *ordered, (plane, node)) {
                    impulses.push(Impulse { plane, node, normal: 0.0, tangential: Vector3::zeros() });
                }
                if gap < 0.99 * skin {
                    add(&mut u[node], free_normal * ((skin - gap) / free_normal.norm_squared()));
                    has_moved = true;
                }
            }
            if *ordered == 0 {
                *ordered = impulses.len();
            }
            if !has_moved {
                return;
            }
        }
    }

    /// The impulses of the last step.
    pub fn impulses(&self) -> &[Impulse] {
        &self.impulses
    }

    /// Adds the impulses of the last step to a history.
    pub fn save(&self, history: &mut History) {
        let numbers = |impulse: &Impulse| {
            let [x, y, z] = impulse.tangential.into();
            [impulse.plane as f64, impulse.node as f64, impulse.normal, x, y, z]
        };
        let all: Vec<[f64; 6]> = self.impulses.iter().map(numbers).collect();
        put(history, "contact.impulses", all.as_flattened());
    }

    /// Restores the quantities that [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        let (numbers, _) = history.get("contact.impulses")?.as_chunks::<6>();
        let impulse = |&[plane, node, normal, x, y, z]: &[f64; 6]| Impulse {
            plane: plane as usize,
            node: node as usize,
            normal,
            tangential: Vector3::new(x, y, z),
        };
        self.impulses = numbers.iter().map(impulse).collect();
        let (planes, nodes) = (self.planes.planes.len(), self.planes.nodes());
        match self.impulses.iter().all(|impulse| impulse.plane < planes && impulse.node < nodes) {
            true => Ok(()),
            false => Err("its `contact.impulses` name a node or a plane that the scene does not have".to_owned()),
        }
    }

    /// Drops the impulses of the last step: the state is a new one.
    pub fn forget(&mut self) {
        self.impulses.clear();
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        self.planes.bytes() + size_of_val(&self.masses[..])
    }
}

impl Impulse {
    /// With the normal of its plane, N s.
    pub fn total(&self, normal: Vector3<f64>) -> Vector3<f64> {
        normal * self.normal + self.tangential
    }
}

/// Returns true if a node that touches a plane is in the list. The first `ordered` entries of the list are sorted.
fn is_listed(impulses: &[Impulse], ordered: usize, key: (usize, usize)) -> bool {
    // The list grows in the first pass, which visits each node once.
    if ordered == 0 {
        return false;
    }
    let key_of = |impulse: &Impulse| (impulse.plane, impulse.node);
    let (first, rest) = impulses.split_at(ordered);
    first.binary_search_by_key(&key, key_of).is_ok() || rest.iter().any(|impulse| key_of(impulse) == key)
}

/// A node that touches a plane.
struct Node {
    mass: f64,
    /// 1 in the directions in which it is free, else 0.
    free: Vector3<f64>,
}

impl Node {
    /// Changes an impulse, and the velocity of its node, so that the node does not approach the plane and satisfies Coulomb's law.
    /// Returns the largest change, N s.
    fn stop<T: Real>(
        &self,
        &ContactPlane { normal, friction, .. }: &ContactPlane,
        velocity: Vector3<f64>,
        impulse: &mut Impulse,
        v: &mut [T; 3],
    ) -> f64 {
        let now = Vector3::from(v.map(|v| v.as_f64()));
        let free_normal = self.free.component_mul(&normal);
        let approach = normal.dot(&(now - velocity));
        let total = f64::max(0.0, impulse.normal - self.mass * approach / free_normal.norm_squared());
        let along = free_normal * (total - impulse.normal);
        let change = (total - impulse.normal).abs();
        impulse.normal = total;
        let slide = now + along / self.mass - velocity;
        let slide = self.free.component_mul(&(slide - normal * normal.dot(&slide)));
        let trial = impulse.tangential - slide * self.mass;
        let (bound, size) = (friction * impulse.normal, trial.norm());
        let tangential = if size > bound { trial * (bound / size) } else { trial };
        let across = tangential - impulse.tangential;
        impulse.tangential = tangential;
        let change = change.max(across.amax());
        if change > 0.0 {
            let v_new = now + (along + self.free.component_mul(&across)) / self.mass;
            *v = [0, 1, 2].map(|i| T::of(v_new[i]));
        }
        change
    }
}

/// The part of a change of velocity that displaces a node in the same step, times dt: that of a constant acceleration.
fn share(kind: IntegratorKind) -> f64 {
    match kind {
        IntegratorKind::ExplicitEuler => 0.0,
        IntegratorKind::SemiImplicitEuler => 1.0,
        _ => 0.5,
    }
}

/// 1 in the directions in which a node is free, else 0.
fn free<T: Real>(system: &System<T>, node: usize) -> Vector3<f64> {
    let constrained = system.dirichlet.constrained(node);
    Vector3::from(constrained.map(|constrained| if constrained { 0.0 } else { 1.0 }))
}

fn add<T: Real>(u: &mut [T; 3], change: Vector3<f64>) {
    *u = triple(|i| T::of(u[i].as_f64() + change[i]));
}
