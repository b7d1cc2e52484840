//! The elements of a body around its nodes, grouped by material.

use std::ops::Range;

use super::nodes::NodeBatches;
use super::patches::Patches;
use super::search::Change;
use super::sums::Sums;
use crate::model::system::System;
use fem_elements::Real;

/// The elements of one material around the nodes.
pub(super) enum Group<T: Real> {
    Tetrahedra(Patches<T, 3>),
    Triangles(Patches<T, 2>),
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

impl<T: Real> Group<T> {
    /// The elements of a material.
    pub fn new(system: &System<T>, material: usize, nodes: &NodeBatches<T>) -> Self {
        let numbers = system.elements.numbers(material);
        let mesh = &system.shape.mesh;
        if let Some(elements) = mesh.arrays::<4>() {
            let corners = system.numbering.elements(numbers.iter().map(|&number| &elements[number]));
            Self::Tetrahedra(Patches::new(system, material, &corners, &numbers, nodes))
        } else if let Some(elements) = mesh.arrays::<3>() {
            let corners = system.numbering.elements(numbers.iter().map(|&number| &elements[number]));
            Self::Triangles(Patches::new(system, material, &corners, &numbers, nodes))
        } else {
            unreachable!("quadratic elements are refused when the scene is loaded")
        }
    }

    /// Adds gradient and block of the elements' energy to the sums of the batches of a colour.
    pub fn add_sums(
        &self,
        system: &System<T>,
        nodes: &NodeBatches<T>,
        color: &Range<usize>,
        u: &[[T; 3]],
        sums: &mut [Sums<T::Lanes>],
    ) {
        with_group!(self, patches => patches.add_sums(system, nodes, color, u, sums));
    }

    /// Adds the changes of the elements' energy at these batches as their nodes move.
    pub fn add_changes(
        &self,
        system: &System<T>,
        nodes: &NodeBatches<T>,
        batches: &[usize],
        u: &[[T; 3]],
        changes: &mut [Change<T>],
    ) {
        with_group!(self, patches => patches.add_changes(system, nodes, batches, u, changes));
    }
}

/// Nodes of each element of a body, in the engine's numbering.
pub(super) fn corners<T: Real>(system: &System<T>) -> Vec<Vec<u32>> {
    let of_element = |corners: &[usize]| corners.iter().map(|&node| system.numbering.engine_node[node]).collect();
    system.shape.mesh.corners().map(of_element).collect()
}
