//! Selectors: the keys by which a table names a part of the mesh.

use fem_model::{Axis, Region, Selector};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Unexpected, Visitor};

use super::Side;
use super::vectors::three_numbers;

/// The selectors among the keys that tables with selectors have in common.
pub(super) fn of_keys(
    on: &Option<On>,
    cuboid: &Option<BoxTable>,
    sphere: &Option<SphereTable>,
    set: &Option<String>,
    nodes: &Option<Vec<usize>>,
) -> Vec<Selector> {
    let on = on.as_ref().map(|on| match *on {
        On::All => Region::All,
        On::Side(SidePlane { axis, side, within }) => Region::Side { axis, side, within },
    });
    let cuboid = cuboid.as_ref().map(|&BoxTable { min, max }| Region::Box { min, max });
    let sphere = sphere.as_ref().map(|&SphereTable { center, radius }| Region::Sphere { center, radius });
    let regions = [on, cuboid, sphere].into_iter().flatten().map(Selector::Region);
    regions.chain(set.clone().map(Selector::Set)).chain(nodes.clone().map(Selector::Nodes)).collect()
}

impl Plane {
    /// Its selector.
    pub(super) fn selector(&self) -> Selector {
        Selector::Region(Region::Plane { axis: self.axis, below: self.below })
    }
}

/// `on`: the whole mesh, or everything near one side.
#[derive(Clone, Debug, PartialEq)]
pub enum On {
    /// `"all"`: all nodes or elements, or the whole boundary.
    All,
    /// `{ axis, side, within }`: everything within a distance of one side, such as `{ axis = "x", side = "max", within = 1e-9 }`.
    Side(SidePlane),
}

impl On {
    /// The side, unless it is everything.
    pub fn side(&self) -> Option<&SidePlane> {
        match self {
            Self::All => None,
            Self::Side(side) => Some(side),
        }
    }
}

/// `on = { … }`: everything within a distance of one side of the mesh's bounding box.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SidePlane {
    /// The coordinate that is constant on the side.
    pub axis: Axis,
    /// The side of the smallest or of the largest value of this coordinate.
    pub side: Side,
    /// Largest distance from that value, m; at least 0.
    pub within: f64,
}

/// `plane`: all nodes whose coordinate is at most the mesh's smallest plus `below`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// The coordinate that is constant on the plane.
    pub axis: Axis,
    /// Distance from the smallest coordinate of the mesh, m; at least 0.
    pub below: f64,
}

/// `box`: a box parallel to the axes, its surface included.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct BoxTable {
    /// Smallest coordinates, m.
    #[serde(deserialize_with = "three_numbers")]
    pub min: [f64; 3],
    /// Largest coordinates, m; at least those of `min`.
    #[serde(deserialize_with = "three_numbers")]
    pub max: [f64; 3],
}

/// `sphere`: a ball, its surface included.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SphereTable {
    /// Centre, m.
    #[serde(deserialize_with = "three_numbers")]
    pub center: [f64; 3],
    /// Radius, m; positive.
    pub radius: f64,
}

impl<'de> Deserialize<'de> for On {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OnVisitor)
    }
}

/// Reads `on = "all"` or `on = { axis = "x", side = "max", within = 1e-9 }`.
struct OnVisitor;

impl<'de> Visitor<'de> for OnVisitor {
    type Value = On;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("\"all\" or { axis, side, within }")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<On, E> {
        if text == "all" { Ok(On::All) } else { Err(E::invalid_value(Unexpected::Str(text), &self)) }
    }

    fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<On, M::Error> {
        SidePlane::deserialize(MapAccessDeserializer::new(map)).map(On::Side)
    }
}
