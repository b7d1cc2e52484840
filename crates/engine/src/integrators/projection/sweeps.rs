//! A step of a position-based method: prediction, sweeps over all constraints, velocities.

use fem_scene::BodyMesh;
use fem_scene::simulation::{Counters, History};

use super::anchor_constraints::AnchorConstraints;
use super::contact::{ContactStep, PlaneContacts};
use super::distances::Distances;
use super::elements::Elements;
use super::particles::{Particles, largest_difference};
use super::rule::{Rule, Sweep};
use crate::forces::contact::planes::Planes;
use crate::forces::springs::Spring;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;

/// The constraints of a body, and its nodes as particles.
pub struct Sweeps<T: Real> {
    rule: Rule,
    count: usize,
    tolerance: Option<f64>,
    particles: Particles<T>,
    groups: Vec<Group<T>>,
    distances: Distances<T>,
    anchors: AnchorConstraints<T>,
    contacts: Option<PlaneContacts>,
    /// Displacements before a sweep, m; empty where no tolerance is asked for.
    before: Vec<[T; 3]>,
    /// Whether the masses of the constraints are those of the Dirichlet conditions that apply now.
    has_masses: bool,
}

/// The elements of one material.
enum Group<T: Real> {
    Tetrahedra(Elements<T, 4>),
    Triangles(Elements<T, 3>),
}

/// Evaluates an expression for the elements of a group.
macro_rules! with_group {
    ($group:expr, $name:ident => $value:expr) => {
        match $group {
            Group::Tetrahedra($name) => $value,
            Group::Triangles($name) => $value,
        }
    };
}

impl<T: Real> Sweeps<T> {
    /// Constraints for all elements of a body, for these springs, and for the planes. A step takes `count` sweeps, or fewer where the
    /// relative change of the velocity falls below the tolerance.
    pub fn new(
        system: &System<T>,
        springs: &[Spring<T>],
        planes: Option<&Planes>,
        (count, tolerance): (usize, Option<f64>),
        rule: Rule,
    ) -> Self {
        let groups = (0..system.elements.materials()).map(|material| Group::new(system, material)).collect();
        Self {
            rule,
            count,
            tolerance,
            particles: Particles::new(system),
            groups,
            distances: Distances::new(system.nodes(), springs),
            anchors: AnchorConstraints::new(),
            contacts: planes.map(|planes| PlaneContacts::new(planes.clone(), system.length)),
            before: if tolerance.is_some() { vec![[T::default(); 3]; system.nodes()] } else { Vec::new() },
            has_masses: false,
        }
    }

    /// Advances displacements and velocities by one step of `dt` seconds.
    pub fn step(&mut self, system: &System<T>, state: &mut State<T>, dt: f64, counters: &mut Counters) {
        if !self.has_masses {
            self.set_masses(system);
        }
        let dt2 = self.particles.predict(system, state, dt);
        let times = [state.time, state.time + dt];
        self.begin_step(system, dt2, times[1]);
        let sweep = Sweep { rule: self.rule, dt2 };
        for _ in 0..self.count {
            counters.solver_iterations += 1;
            if self.tolerance.is_some() {
                self.before.copy_from_slice(&state.u);
            }
            self.sweep(system, sweep, times, &mut state.u);
            if self.tolerance.is_some_and(|tolerance| self.has_settled(&state.u, tolerance)) {
                break;
            }
        }
        let Self { particles, contacts, .. } = self;
        if let Some(contacts) = contacts {
            contacts.end_step(contact_step(particles, times), &mut state.u);
        }
        particles.finish(state, dt);
    }

    fn set_masses(&mut self, system: &System<T>) {
        self.particles.set_masses(system);
        let masses = &self.particles.inverse_masses;
        self.groups.iter_mut().for_each(|group| with_group!(group, elements => elements.set_masses(masses)));
        self.has_masses = true;
    }

    fn begin_step(&mut self, system: &System<T>, dt2: f64, end: f64) {
        self.groups.iter_mut().for_each(|group| with_group!(group, elements => elements.begin_step()));
        self.distances.begin_step();
        self.anchors.begin_step(&system.forces.anchors, end);
        if let Some(contacts) = &mut self.contacts {
            contacts.begin_step(dt2);
        }
    }

    fn sweep(&mut self, system: &System<T>, sweep: Sweep, times: [f64; 2], u: &mut [[T; 3]]) {
        let Self { particles, groups, distances, anchors, contacts, .. } = self;
        let masses = &particles.inverse_masses;
        for group in groups {
            system.profile.forces.time(|| with_group!(group, elements => elements.sweep(system, sweep, u)));
        }
        distances.sweep(sweep, masses, u);
        system.forces.anchors_timer.time(|| anchors.sweep(sweep.dt2, masses, u));
        if let Some(contacts) = contacts {
            contacts.sweep(contact_step(particles, times), u);
        }
    }

    fn has_settled(&self, u: &[[T; 3]], tolerance: f64) -> bool {
        largest_difference(u, &self.before) <= tolerance * self.particles.largest_increment(u)
    }

    /// The conditions that apply, or a parameter, have changed.
    pub fn forget(&mut self) {
        self.has_masses = false;
        if let Some(contacts) = &mut self.contacts {
            contacts.begin_step(1.0);
        }
    }

    /// Contacts with planes, where the scene has some.
    pub fn contacts(&self) -> Option<&PlaneContacts> {
        self.contacts.as_ref()
    }

    /// Adds what reports take from the last step.
    pub fn save(&self, history: &mut History) {
        if let Some(contacts) = &self.contacts {
            contacts.save(history);
        }
    }

    /// Takes over what [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        self.contacts.as_mut().map_or(Ok(()), |contacts| contacts.restore(history))
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        let of_groups = self.groups.iter().map(|group| with_group!(group, elements => elements.bytes()));
        let of_nodes = 9 * size_of::<T>() * self.particles.inverse_masses.len() + size_of_val(&self.before[..]);
        let of_contacts = self.contacts.as_ref().map_or(0, |contacts| contacts.bytes());
        of_groups.sum::<usize>() + self.distances.bytes() + of_contacts + of_nodes
    }
}

fn contact_step<T: Real>(particles: &Particles<T>, times: [f64; 2]) -> ContactStep<'_, T> {
    ContactStep { start: &particles.start, inverse_masses: &particles.inverse_masses, times }
}

impl<T: Real> Group<T> {
    fn new(system: &System<T>, material: usize) -> Self {
        let numbers = system.elements.numbers(material);
        match &system.shape.mesh {
            BodyMesh::Solid(mesh) => {
                let corners = system.numbering.elements(numbers.iter().map(|&number| &mesh.elements[number]));
                Self::Tetrahedra(Elements::new(system, material, &corners, &numbers))
            }
            BodyMesh::Flat { triangles, .. } => {
                let corners = system.numbering.elements(numbers.iter().map(|&number| &triangles.elements[number]));
                Self::Triangles(Elements::new(system, material, &corners, &numbers))
            }
            BodyMesh::Quadratic { .. } => unreachable!("quadratic elements are refused when the scene is loaded"),
        }
    }
}
