//! The elements of a body around its nodes, grouped by material.

use super::nodes::NodeBatches;
use super::patches::{Group, Patches};
use crate::model::system::System;
use fem_solvers::Real;

/// The elements of a material around the nodes.
pub(super) fn group<T: Real>(system: &System<T>, material: usize, nodes: &NodeBatches<T>) -> Box<dyn Group<T>> {
    let mesh = &system.shape.mesh;
    if let Some(tetrahedra) = mesh.arrays::<4>() {
        Box::new(Patches::<T, 3>::new(system, material, tetrahedra, nodes))
    } else if let Some(triangles) = mesh.arrays::<3>() {
        Box::new(Patches::<T, 2>::new(system, material, triangles, nodes))
    } else {
        unreachable!("quadratic elements are refused when the scene is loaded")
    }
}

/// Nodes of each element of a body, in the engine's numbering.
pub(super) fn corners<T: Real>(system: &System<T>) -> Vec<Vec<u32>> {
    let of_element = |corners: &[usize]| corners.iter().map(|&node| system.numbering.engine_node[node]).collect();
    system.shape.mesh.corners().map(of_element).collect()
}
