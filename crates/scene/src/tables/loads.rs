//! The tables of external forces: gravity, body force, traction, nodal forces, springs, the scripted drag.

use fem_model::Selector;
use serde::Deserialize;
use serde::de::{Error, Visitor};

use super::selector::of_keys;
use super::vectors::{edges_if_any, three_numbers, three_numbers_if_any, triangles_if_any, two_nodes};
use super::{BoxTable, CurveTable, On, Plane, SphereTable};

/// `[gravity]`: the weight of every node.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct GravityTable {
    /// Acceleration, m/s².
    #[serde(deserialize_with = "three_numbers")]
    pub acceleration: [f64; 3],
    /// Factor of time on it. Engine only. Default: constant.
    pub curve: Option<CurveTable>,
}

/// `[body_force]`: a force on every part of the body, independent of its density. Engine only.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct BodyForceTable {
    /// Force per undeformed volume, N/m³.
    #[serde(deserialize_with = "three_numbers")]
    pub density: [f64; 3],
    /// Factor of time on it. Default: constant.
    pub curve: Option<CurveTable>,
}

/// `[[traction]]`: a force on a part of the surface, spread evenly over it. One selector, and either `force_per_area` or `pressure`. Engine
/// only.
///
/// A flat body is loaded on edges of its outline, `thickness` times their length.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct TractionTable {
    /// All boundary triangles near one side of the mesh, or the whole boundary.
    pub on: Option<On>,
    /// All boundary triangles in a box.
    #[serde(rename = "box")]
    pub cuboid: Option<BoxTable>,
    /// All boundary triangles in a sphere.
    pub sphere: Option<SphereTable>,
    /// The triangles of a named set of the mesh.
    pub set: Option<String>,
    /// These boundary triangles, each by its three nodes in any order.
    #[serde(default, deserialize_with = "triangles_if_any")]
    pub faces: Option<Vec<[usize; 3]>>,
    /// These edges of a flat body's outline, each by its two ends in any order.
    #[serde(default, deserialize_with = "edges_if_any")]
    pub edges: Option<Vec<[usize; 2]>>,
    /// Dead load: force per undeformed area, Pa. It keeps its direction and its sum.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub force_per_area: Option<[f64; 3]>,
    /// Follower load: pressure against the deformed surface, Pa; positive pushes inwards.
    pub pressure: Option<f64>,
    /// Factor of time on it. Default: constant.
    pub curve: Option<CurveTable>,
}

impl TractionTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        let mut selectors = of_keys(&self.on, &self.cuboid, &self.sphere, &self.set, &None);
        selectors.extend(self.faces.clone().map(Selector::Faces));
        selectors.extend(self.edges.clone().map(Selector::Edges));
        selectors
    }
}

/// `[[force]]`: a dead load on single nodes. One selector, and a force. Engine only.
///
/// A node that several tables name carries the sum of their forces. On a constrained coordinate the force goes into the reaction.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct ForceTable {
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
    /// Force on each of the nodes, N: n nodes carry n times as much together. It keeps its direction.
    #[serde(deserialize_with = "three_numbers")]
    pub value: [f64; 3],
    /// Factor of time on it. Default: constant.
    pub curve: Option<CurveTable>,
}

impl ForceTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        let mut selectors = of_keys(&self.on, &self.cuboid, &self.sphere, &self.set, &self.nodes);
        selectors.extend(self.plane.as_ref().map(Plane::selector));
        selectors
    }
}

/// `[[springs]]`: a spring between two nodes with the energy ½ k (|x_b − x_a| − l)². Engine only.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SpringTable {
    /// The nodes a and b at its ends, two different ones.
    #[serde(deserialize_with = "two_nodes")]
    pub nodes: [usize; 2],
    /// Stiffness k, N/m; positive.
    pub stiffness: f64,
    /// Rest length l, m; at least 0. Default: the undeformed distance of the nodes.
    pub rest_length: Option<f64>,
    /// Coefficient c of a damper beside the spring with the force c (v_b − v_a)·n along it, N s/m; at least 0.
    #[serde(default)]
    pub damping: f64,
}

/// `[drag]`: a spring of zero rest length that pulls a node towards a moving target: its undeformed position
/// + direction · amplitude · sin(2π · frequency · t).
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct DragTable {
    /// The node that the spring pulls.
    pub vertex: DragVertex,
    /// Stiffness of the spring, N/m; positive.
    pub stiffness: f64,
    /// Direction of the target's motion, not zero; used as given, not normalised.
    #[serde(deserialize_with = "three_numbers")]
    pub direction: [f64; 3],
    /// Amplitude of the target's motion, m.
    pub amplitude: f64,
    /// Frequency of the target's motion, Hz; at least 0.
    pub frequency: f64,
    /// True if the stiffness contains the spring of the drag, or that of the mouse. In the assignment it does not, and
    /// linearly implicit Euler treats the spring explicitly. The engine's stiffness always contains it; `false` is for
    /// `pipeline = "course"`. Without `[drag]` the stiffness contains the spring of the mouse.
    ///
    /// Default: `false` in the pipeline `"course"`, `true` in `"engine"`.
    pub in_stiffness: Option<bool>,
}

/// The node of a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DragVertex {
    /// `"highest"`: the first node of largest y.
    Highest,
    /// an index: the node of this index, from 0.
    Index(usize),
}

impl<'de> Deserialize<'de> for DragVertex {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(DragVertexVisitor)
    }
}

/// Reads `vertex = "highest"` or `vertex = 12`.
struct DragVertexVisitor;

impl Visitor<'_> for DragVertexVisitor {
    type Value = DragVertex;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("\"highest\" or the index of a vertex")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<DragVertex, E> {
        if text == "highest" {
            Ok(DragVertex::Highest)
        } else {
            Err(E::invalid_value(serde::de::Unexpected::Str(text), &self))
        }
    }

    fn visit_i64<E: Error>(self, index: i64) -> Result<DragVertex, E> {
        let valid = usize::try_from(index).map(DragVertex::Index);
        valid.map_err(|_| E::invalid_value(serde::de::Unexpected::Signed(index), &self))
    }
}
