//! The constraints of a body, which a sweep corrects one after the other.

use super::distances::Distances;
use super::drag_constraints::DragConstraints;
use super::elements::{Elements, Group};
use super::rule::{Rule, Sweep};
use crate::forces::springs::Spring;
use crate::integrators::relaxation::{PlaneContacts, Relaxation, StepOf};
use crate::model::system::System;
use fem_solvers::Real;

/// The constraints of a body.
pub struct Constraints<T: Real> {
    rule: Rule,
    groups: Vec<Box<dyn Group<T>>>,
    distances: Distances<T>,
    drag: DragConstraints<T>,
}

impl<T: Real> Constraints<T> {
    /// Constraints for all elements of a body, and for these springs.
    pub fn new(system: &System<T>, springs: &[Spring<T>], rule: Rule) -> Self {
        let groups = (0..system.elements.materials()).map(|material| group(system, material)).collect();
        let distances = Distances::new(system.nodes(), springs);
        Self { rule, groups, distances, drag: DragConstraints::new() }
    }
}

impl<T: Real> Relaxation<T> for Constraints<T> {
    fn set_masses(&mut self, inverse_masses: &[[T; 3]]) {
        for group in &mut self.groups {
            group.set_masses(inverse_masses);
        }
    }

    fn has_material(&self) -> bool {
        self.rule.has_force()
    }

    fn begin_step(&mut self, step: StepOf<T>, _u: &[[T; 3]]) {
        self.groups.iter_mut().for_each(|group| group.begin_step());
        self.distances.begin_step();
        self.drag.begin_step(&step.system.forces.drag, step.times[1]);
    }

    fn sweep(&mut self, step: StepOf<T>, contacts: Option<&mut PlaneContacts>, u: &mut [[T; 3]]) {
        let Self { rule, groups, distances, drag } = self;
        let StepOf { system, particles, dt2, .. } = step;
        let (sweep, masses) = (Sweep { rule: *rule, dt2 }, &particles.inverse_masses);
        for group in groups {
            system.profile.forces.time(|| group.sweep(system, sweep, u));
        }
        distances.sweep(sweep, masses, u);
        system.forces.drag_timer.time(|| drag.sweep(dt2, masses, u));
        if let Some(contacts) = contacts {
            contacts.sweep(step.of_contacts(), u);
        }
    }
}

/// The constraints of the elements of a material.
fn group<T: Real>(system: &System<T>, material: usize) -> Box<dyn Group<T>> {
    let mesh = &system.shape.mesh;
    if let Some(tetrahedra) = mesh.arrays::<4>() {
        Box::new(Elements::new(system, material, tetrahedra))
    } else if let Some(triangles) = mesh.arrays::<3>() {
        Box::new(Elements::new(system, material, triangles))
    } else {
        unreachable!("quadratic elements are refused when the scene is loaded")
    }
}
