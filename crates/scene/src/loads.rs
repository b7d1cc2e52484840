//! Tables of what pulls and pushes a body: gravity, body force, traction, springs, the scripted drag.

use serde::Deserialize;

use super::{Axis, Side, load};

/// `[gravity]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// m/s²
    #[serde(deserialize_with = "load::three_numbers")]
    pub acceleration: [f64; 3],
}

/// `[body_force]`: a force on every piece of the body, whatever its density.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct BodyForce {
    /// Force per undeformed volume, N/m³.
    #[serde(deserialize_with = "load::three_numbers")]
    pub density: [f64; 3],
}

/// `[[traction]]`: a force on a part of the surface, spread evenly over it. `on` or `faces`, and one kind of force.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Traction {
    /// All boundary triangles on one side of the mesh.
    pub on: Option<SidePlane>,
    /// These boundary triangles, each by its three nodes in any order.
    #[serde(default, deserialize_with = "load::triangles_if_any")]
    pub faces: Option<Vec<[usize; 3]>>,
    /// Dead load: force per undeformed area, Pa. It keeps its direction and its sum.
    #[serde(default, deserialize_with = "load::three_numbers_if_any")]
    pub force_per_area: Option<[f64; 3]>,
    /// Follower load: pressure against the deformed surface, Pa; positive pushes inward.
    pub pressure: Option<f64>,
}

/// All nodes within a distance of one side of the mesh's bounding box.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SidePlane {
    /// Which coordinate.
    pub axis: Axis,
    /// The side of its smallest or of its largest value.
    pub side: Side,
    /// Largest distance from that value, m.
    pub within: f64,
}

/// `[[springs]]`: a spring between two nodes, ½ k (|x_b − x_a| − l)².
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Spring {
    /// The nodes a and b that it joins.
    #[serde(deserialize_with = "load::two_nodes")]
    pub nodes: [usize; 2],
    /// k, N/m.
    pub stiffness: f64,
    /// l, m; the distance of the undeformed nodes where it is left out.
    pub rest_length: Option<f64>,
}

/// `[drag]`: a spring of no rest length from a vertex to a target that swings about where the vertex was at rest.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// The vertex that is pulled.
    pub vertex: DragVertex,
    /// N/m
    pub stiffness: f64,
    /// Taken as it is, not normalised.
    #[serde(deserialize_with = "load::three_numbers")]
    pub direction: [f64; 3],
    /// m
    pub amplitude: f64,
    /// Hz
    pub frequency: f64,
}

/// The vertex of a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DragVertex {
    /// The first vertex of largest y.
    Highest,
    /// This one.
    Index(usize),
}

impl<'de> Deserialize<'de> for DragVertex {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(load::DragVertexVisitor)
    }
}
