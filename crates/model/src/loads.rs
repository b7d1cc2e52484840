//! External forces: tractions, pressures, nodal forces, springs, the scripted drag.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use crate::{BodyMesh, LoadCurve};

/// Dead load on a part of the surface: it keeps its direction and its sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Traction {
    /// Nodes of each part of the boundary: triangles of a solid body, edges of a flat one, as in [`BodyMesh::faces`].
    pub faces: Vec<Vec<usize>>,
    /// Force per undeformed area, Pa.
    pub force_per_area: Vector3<f64>,
    /// Factor of time on it.
    pub curve: Option<LoadCurve>,
}

/// Follower load on a part of the surface: it acts along the normal of the deformed triangles or edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressure {
    /// Nodes of each part of the boundary: triangles of a solid body, counter-clockwise from outside; edges of a flat one, as in
    /// [`BodyMesh::faces`].
    pub faces: Vec<Vec<usize>>,
    /// Force per deformed area, Pa; positive pushes inward.
    pub pressure: f64,
    /// Factor of time on it.
    pub curve: Option<LoadCurve>,
}

/// Dead load on single nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct NodalForce {
    /// Nodes, ascending and without repeats.
    pub nodes: Vec<usize>,
    /// Force on each of them, N.
    pub force: Vector3<f64>,
    /// Factor of time on it.
    pub curve: Option<LoadCurve>,
}

/// A spring between two nodes, ½ k (|x_b − x_a| − l)², with a damper beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// The nodes a and b at its ends.
    pub nodes: [usize; 2],
    /// k, N/m.
    pub stiffness: f64,
    /// l, m.
    pub rest_length: f64,
    /// True if l is by definition the undeformed distance of the nodes: any difference is round-off and no strain.
    pub is_initially_relaxed: bool,
    /// c, N s/m.
    pub damping: f64,
}

/// A spring of zero rest length from a node to a target that oscillates about the node's undeformed position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// The node at one end of the spring.
    pub node: usize,
    /// N/m
    pub stiffness: f64,
    /// Used as given, not normalised.
    pub direction: Vector3<f64>,
    /// m
    pub amplitude: f64,
    /// Hz
    pub frequency: f64,
}

impl Drag {
    /// Displacement of the target from the node's undeformed position at a time (s), m: direction · amplitude · sin 2π f t.
    pub fn displacement(&self, time: f64) -> Vector3<f64> {
        self.direction * (self.amplitude * (TAU * self.frequency * time).sin())
    }
}

/// The first node of largest y in the undeformed mesh.
pub fn highest_node(mesh: &BodyMesh) -> usize {
    let heights = mesh.vertices().iter().map(|vertex| vertex.y).enumerate();
    let higher = |best: (usize, f64), next: (usize, f64)| if next.1 > best.1 { next } else { best };
    heights.fold((0, f64::NEG_INFINITY), higher).0
}
