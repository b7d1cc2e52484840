//! The constraints of a body, which a sweep corrects one after the other.

use super::anchor_constraints::AnchorConstraints;
use super::distances::Distances;
use super::elements::Elements;
use super::rule::{Rule, Sweep};
use crate::forces::springs::Spring;
use crate::integrators::relaxation::{PlaneContacts, Relaxation, StepOf};
use crate::model::system::System;
use fem_elements::Real;

/// The constraints of a body.
pub struct Constraints<T: Real> {
    rule: Rule,
    groups: Vec<Group<T>>,
    distances: Distances<T>,
    anchors: AnchorConstraints<T>,
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

impl<T: Real> Constraints<T> {
    /// Constraints for all elements of a body, and for these springs.
    pub fn new(system: &System<T>, springs: &[Spring<T>], rule: Rule) -> Self {
        let groups = (0..system.elements.materials()).map(|material| Group::new(system, material)).collect();
        let distances = Distances::new(system.nodes(), springs);
        Self { rule, groups, distances, anchors: AnchorConstraints::new() }
    }
}

impl<T: Real> Relaxation<T> for Constraints<T> {
    fn set_masses(&mut self, inverse_masses: &[[T; 3]]) {
        for group in &mut self.groups {
            with_group!(group, elements => elements.set_masses(inverse_masses));
        }
    }

    fn has_material(&self) -> bool {
        self.rule.has_force()
    }

    fn begin_step(&mut self, step: StepOf<T>, _u: &[[T; 3]]) {
        self.groups.iter_mut().for_each(|group| with_group!(group, elements => elements.begin_step()));
        self.distances.begin_step();
        self.anchors.begin_step(&step.system.forces.anchors, step.times[1]);
    }

    fn sweep(&mut self, step: StepOf<T>, contacts: Option<&mut PlaneContacts>, u: &mut [[T; 3]]) {
        let Self { rule, groups, distances, anchors } = self;
        let StepOf { system, particles, dt2, .. } = step;
        let (sweep, masses) = (Sweep { rule: *rule, dt2 }, &particles.inverse_masses);
        for group in groups {
            system.profile.forces.time(|| with_group!(group, elements => elements.sweep(system, sweep, u)));
        }
        distances.sweep(sweep, masses, u);
        system.forces.anchors_timer.time(|| anchors.sweep(dt2, masses, u));
        if let Some(contacts) = contacts {
            contacts.sweep(step.of_contacts(), u);
        }
    }
}

impl<T: Real> Group<T> {
    fn new(system: &System<T>, material: usize) -> Self {
        let numbers = system.elements.numbers(material);
        let mesh = &system.shape.mesh;
        if let Some(elements) = mesh.arrays::<4>() {
            let corners = system.numbering.elements(numbers.iter().map(|&number| &elements[number]));
            Self::Tetrahedra(Elements::new(system, material, &corners, &numbers))
        } else if let Some(elements) = mesh.arrays::<3>() {
            let corners = system.numbering.elements(numbers.iter().map(|&number| &elements[number]));
            Self::Triangles(Elements::new(system, material, &corners, &numbers))
        } else {
            unreachable!("quadratic elements are refused when the scene is loaded")
        }
    }
}
