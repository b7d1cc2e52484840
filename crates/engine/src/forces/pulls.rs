//! Pulls at single nodes: the scene's scripted one, or those of a person's hand, which take its place.

use crate::model::system::System;
use crate::number::Real;
use fem_scene::simulation::Pull;

/// A spring of no rest length from a node to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnchorSpring<T> {
    /// The engine's number of the node.
    pub node: usize,
    /// Displacement at which the spring is at rest, m.
    pub target: [T; 3],
    /// N/m
    pub stiffness: T,
}

/// All that is needed to know the pulls at any time: explicit methods ask for times within a step.
#[derive(Clone, Copy)]
pub struct Pulls<'a, T: Real> {
    /// The body.
    pub system: &'a System<T>,
    /// What a person holds.
    pub hand: Option<&'a Pull>,
    /// Stiffness of every pull, N/m.
    pub stiffness: f64,
}

impl<T: Real> Pulls<'_, T> {
    /// Writes the pulls at a time, s.
    pub fn at(&self, time: f64, springs: &mut Vec<AnchorSpring<T>>) {
        springs.clear();
        let stiffness = T::of(self.stiffness);
        let Some(hand) = self.hand else {
            springs.extend(self.system.drag.iter().map(|drag| {
                let target = drag.displacement(time);
                AnchorSpring { node: drag.node, target: [T::of(target.x), T::of(target.y), T::of(target.z)], stiffness }
            }));
            return;
        };
        springs.extend(hand.anchors.iter().map(|&(node, anchor)| {
            let target = anchor + hand.offset - self.system.shape.mesh.vertices[node];
            let node = self.system.order.engine_node[node] as usize;
            AnchorSpring { node, target: [T::of(target.x), T::of(target.y), T::of(target.z)], stiffness }
        }));
    }
}
