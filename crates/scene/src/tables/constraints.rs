//! The tables of Dirichlet conditions: `[fixed]` and `[[prescribed]]`.

use serde::Deserialize;

use super::vectors::{three_numbers, three_numbers_if_any};
use super::{Axis, BoxTable, CurveTable, On, Plane, Region, Selector, SphereTable};

/// `[fixed]`: nodes that do not move, by one selector.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct FixedTable {
    /// All nodes on one side of a plane.
    pub plane: Option<Plane>,
    /// All nodes on one side of the mesh, or all nodes.
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
    /// Time from which the nodes are free, s.
    pub until: Option<f64>,
}

/// `[[prescribed]]`: nodes with a prescribed motion. One selector, and a displacement, a rotation, or both; or a velocity.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PrescribedTable {
    /// All nodes on one side of the mesh, or all nodes.
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
    /// Displacement from the undeformed position at the end of the motion, m.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub displacement: Option<[f64; 3]>,
    /// The prescribed coordinates; the others are free. All three by default.
    pub components: Option<Vec<Axis>>,
    /// A rotation about an axis, before the displacement.
    pub rotation: Option<RotationTable>,
    /// Velocity, m/s, times the factor of `curve`; in place of a displacement and a rotation.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub velocity: Option<[f64; 3]>,
    /// Time in which the motion grows linearly from zero to its full size, s; the nodes keep their place afterwards. Without it,
    /// the full motion applies from the first step on. A static scene applies the motion in its load steps instead.
    pub over: Option<f64>,
    /// Part of the full motion, or factor of the velocity, as a function of time, in place of `over`.
    pub curve: Option<CurveTable>,
    /// Time from which the nodes are free, s.
    pub until: Option<f64>,
}

/// A rotation about a line parallel to a coordinate axis.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct RotationTable {
    /// The direction of the line.
    pub axis: Axis,
    /// A point of the line, m.
    #[serde(deserialize_with = "three_numbers")]
    pub center: [f64; 3],
    /// Full turns, counter-clockwise seen against the direction of the axis.
    pub turns: f64,
}

impl FixedTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        let mut selectors = Selector::of_keys(&self.on, &self.cuboid, &self.sphere, &self.set);
        selectors.extend(self.plane.clone().map(|plane| Selector::Region(Region::Plane(plane))));
        selectors.extend(self.nodes.clone().map(Selector::Nodes));
        selectors
    }
}

impl PrescribedTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        let mut selectors = Selector::of_keys(&self.on, &self.cuboid, &self.sphere, &self.set);
        selectors.extend(self.nodes.clone().map(Selector::Nodes));
        selectors
    }

    /// Whether x, y and z are prescribed.
    pub(crate) fn is_prescribed(&self) -> [bool; 3] {
        let named = |axis| self.components.as_ref().is_none_or(|components| components.contains(&axis));
        [Axis::X, Axis::Y, Axis::Z].map(named)
    }
}
