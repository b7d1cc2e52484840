//! Pulling a body at some of its nodes.

use bevy::ecs::component::Component;
use bevy::math::{DVec3, Vec3};
use fem_model::simulation::Pull;
use nalgebra::Vector3;

use crate::{SoftBodyError, SoftBodyHit, SoftBodyState};

/// Springs that pull nodes of the body, from when the component is inserted until it is removed. They replace the scene's `[drag]`, which
/// goes on afterwards.
///
/// A change applies to the steps that are requested afterwards: with the same frames, a pull gives the same motion on every machine
/// that keeps up.
#[derive(Clone, Component, Debug, PartialEq)]
pub struct SoftBodyPull {
    /// Nodes, and the position of each when the pull began, in the body's frame, m.
    pub anchors: Vec<(usize, DVec3)>,
    /// Displacement of all anchors since then, in the body's frame, m.
    pub offset: Vec3,
    /// Stiffness of each spring, N/m; from 1 to 1e8.
    pub stiffness: f64,
    /// The point under the cursor when the pull began, in the body's frame, m.
    pub grabbed: Vec3,
}

impl SoftBodyPull {
    /// A pull at the nodes of a hit from where they are now. `stiffness` of each spring in N/m.
    pub fn new(state: &SoftBodyState, hit: &SoftBodyHit, stiffness: f64) -> Self {
        let positions = state.positions();
        let anchors = hit.nodes.iter().filter_map(|&node| Some((node, *positions.get(node)?))).collect();
        Self { anchors, offset: Vec3::ZERO, stiffness, grabbed: hit.point }
    }

    /// Moves the anchors so that the grabbed point is pulled to `target`, in the body's frame, m.
    pub fn pull_to(&mut self, target: Vec3) {
        self.offset = target - self.grabbed;
    }

    /// The pull for a body with this many nodes. Returns an error that names the field that is wrong.
    pub(crate) fn checked(&self, nodes: usize) -> Result<Pull, SoftBodyError> {
        let refuse = |text: String| Err(SoftBodyError::Pull(format!("SoftBodyPull.{text}")));
        if let Some((node, _)) = self.anchors.iter().find(|(node, _)| *node >= nodes) {
            return refuse(format!("anchors: node {node} is not one of the {nodes} nodes; count from 0"));
        }
        if let Some((node, _)) = self.anchors.iter().find(|(_, place)| !place.is_finite()) {
            return refuse(format!("anchors: the place of node {node} is not finite; give m"));
        }
        if !self.offset.is_finite() {
            return refuse(format!("offset is {}; give finite numbers of m", self.offset));
        }
        let vector = |x: DVec3| Vector3::new(x.x, x.y, x.z);
        let anchors = self.anchors.iter().map(|&(node, place)| (node, vector(place))).collect();
        Ok(Pull { anchors, offset: vector(self.offset.as_dvec3()) })
    }
}
