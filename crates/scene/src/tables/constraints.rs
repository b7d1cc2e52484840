//! The tables of Dirichlet conditions: `[fixed]` and `[[prescribed]]`.

use fem_model::{Axis, Selector};
use serde::Deserialize;

use super::selector::of_keys;
use super::vectors::{three_numbers, three_numbers_if_any};
use super::{BoxTable, CurveTable, On, Plane, SphereTable};

/// `[fixed]`: nodes that do not move, named by one selector.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct FixedTable {
    /// All nodes near the side of the smallest coordinate along an axis.
    pub plane: Option<Plane>,
    /// All nodes near one side of the mesh, or all nodes.
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
    /// Time from which the nodes are free, s: from the first step that begins at it or after it. Positive. Engine only, and not
    /// with `static`. Default: never.
    pub until: Option<f64>,
}

/// `[[prescribed]]`: nodes with a prescribed motion. One selector, and a displacement, a rotation, or both; or a velocity. Engine only.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PrescribedTable {
    /// All nodes near one side of the mesh, or all nodes.
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
    /// Displacement from the undeformed position at the end of the motion, m. Default: zero.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub displacement: Option<[f64; 3]>,
    /// The prescribed coordinates, such as `["x"]`; the others are free. A rotation prescribes all three. Default: all three.
    pub components: Option<Vec<Axis>>,
    /// Rotation about an axis, before the displacement. Default: none.
    pub rotation: Option<RotationTable>,
    /// Velocity, m/s: constant, or times the factor of `curve`, whose integral is exact. Not with `static`, `displacement`, `rotation` or
    /// `over`. Default: none.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub velocity: Option<[f64; 3]>,
    /// Time in which the motion grows linearly from zero to its full size, s; positive. The nodes keep their place afterwards. With
    /// `static` the motion grows with the load steps instead. Default: at once, the full motion applies from the first step on.
    pub over: Option<f64>,
    /// Part of the full motion, or factor of the velocity, as a function of time, with `static` of the time that load steps count; in place
    /// of `over`. Default: that of `over`.
    pub curve: Option<CurveTable>,
    /// Time from which the nodes are free, s; positive, and not with `static`. Default: never.
    pub until: Option<f64>,
}

/// `rotation`: a rotation about a line parallel to a coordinate axis; `"z"` for a flat body.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct RotationTable {
    /// The direction of the line.
    pub axis: Axis,
    /// A point of the line, m.
    #[serde(deserialize_with = "three_numbers")]
    pub center: [f64; 3],
    /// Number of full turns, counter-clockwise seen against the direction of the axis; at most 1e6 either way.
    pub turns: f64,
}

impl FixedTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        let mut selectors = of_keys(&self.on, &self.cuboid, &self.sphere, &self.set, &self.nodes);
        selectors.extend(self.plane.as_ref().map(Plane::selector));
        selectors
    }
}

impl PrescribedTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        of_keys(&self.on, &self.cuboid, &self.sphere, &self.set, &self.nodes)
    }

    /// Returns true for each of x, y and z that is prescribed.
    pub(crate) fn is_prescribed(&self) -> [bool; 3] {
        let named = |axis| self.components.as_ref().is_none_or(|components| components.contains(&axis));
        [Axis::X, Axis::Y, Axis::Z].map(named)
    }
}
