//! `[[initial_velocity]]`: velocities of nodes at the start.

use std::path::PathBuf;

use fem_model::Selector;
use serde::Deserialize;

use super::selector::of_keys;
use super::vectors::{three_numbers, three_numbers_if_any};
use super::{BoxTable, On, SphereTable};

/// `[[initial_velocity]]`: velocities at the start, the sum of `velocity`, `angular` and `per_node` at the selected nodes. Engine only, and
/// not with `static`.
///
/// At most one selector; without it all nodes are selected. Velocities of several tables are added. Constrained nodes keep their prescribed motion.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct InitialVelocityTable {
    /// All nodes near one side of the mesh, or all nodes. Default: `"all"`, without another selector.
    pub on: Option<On>,
    /// All nodes in a box.
    #[serde(rename = "box")]
    pub cuboid: Option<BoxTable>,
    /// All nodes in a sphere.
    pub sphere: Option<SphereTable>,
    /// The nodes of a named set of the mesh.
    pub set: Option<String>,
    /// These nodes, by their index from 0.
    pub nodes: Option<Vec<usize>>,
    /// The same velocity at every node, m/s. Default: zero.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub velocity: Option<[f64; 3]>,
    /// Velocity of a rotation. Default: none.
    pub angular: Option<AngularVelocityTable>,
    /// A file with a line `x,y,z` of velocities, m/s, for each node of the mesh; beside the scene or in `data`. Default: none.
    pub per_node: Option<PathBuf>,
}

/// `angular`: the velocity of a rotation about a line, v = rate · axis/|axis| × (X − center).
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AngularVelocityTable {
    /// Direction of the line, of any length above zero; along z for a flat body.
    #[serde(deserialize_with = "three_numbers")]
    pub axis: [f64; 3],
    /// A point of the line, m. Default: the centre of mass of the undeformed body.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub center: Option<[f64; 3]>,
    /// Angular velocity, rad/s, counter-clockwise seen against the direction.
    pub rate: f64,
}

impl InitialVelocityTable {
    /// The selectors that the table gives; at most one in a checked scene, and all nodes without one.
    pub fn selectors(&self) -> Vec<Selector> {
        of_keys(&self.on, &self.cuboid, &self.sphere, &self.set, &self.nodes)
    }
}
