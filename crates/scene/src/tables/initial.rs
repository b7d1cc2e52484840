//! `[[initial_velocity]]`: velocities of nodes at the start.

use std::path::PathBuf;

use serde::Deserialize;

use super::vectors::{three_numbers, three_numbers_if_any};
use super::{BoxTable, On, Selector, SphereTable};

/// `[[initial_velocity]]`: the sum of its parts at the selected nodes. Velocities of several tables are added.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct InitialVelocityTable {
    /// All nodes on one side of the mesh, or all nodes: that is the default.
    pub on: Option<On>,
    /// All nodes in a box.
    #[serde(rename = "box")]
    pub cuboid: Option<BoxTable>,
    /// All nodes in a sphere.
    pub sphere: Option<SphereTable>,
    /// The nodes of a named set.
    pub set: Option<String>,
    /// These nodes.
    pub nodes: Option<Vec<usize>>,
    /// The same velocity at every node, m/s.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub velocity: Option<[f64; 3]>,
    /// Velocity of a rotation.
    pub angular: Option<AngularVelocityTable>,
    /// A file with a line `x,y,z` of velocities, m/s, for each node of the mesh.
    pub per_node: Option<PathBuf>,
}

/// A rotation about a line: v = rate · axis/|axis| × (X − center).
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AngularVelocityTable {
    /// Direction of the line, of any length.
    #[serde(deserialize_with = "three_numbers")]
    pub axis: [f64; 3],
    /// A point of the line, m; the centre of mass of the undeformed body by default.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub center: Option<[f64; 3]>,
    /// Radians per second, counter-clockwise seen against the direction.
    pub rate: f64,
}

impl InitialVelocityTable {
    /// The selectors that the table gives; at most one in a checked scene, and all nodes without one.
    pub fn selectors(&self) -> Vec<Selector> {
        let mut selectors = Selector::of_keys(&self.on, &self.cuboid, &self.sphere, &self.set);
        selectors.extend(self.nodes.clone().map(Selector::Nodes));
        selectors
    }
}
