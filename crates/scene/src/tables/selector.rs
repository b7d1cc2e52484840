//! Selectors: the keys by which a table names a part of the mesh.

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Unexpected, Visitor};

use super::vectors::three_numbers;
use super::{Axis, Side};

/// A part of the mesh, by the one key that a table gives. A selection without a node, an element or a triangle is an error.
///
/// A triangle is selected if all of its corners are, an element if its centroid is, an edge of a flat body's outline if its two ends are.
#[derive(Clone, Debug, PartialEq)]
pub enum Selector {
    /// `on`, `plane`, `box` or `sphere`: a region of space.
    Region(Region),
    /// `set`: a named set of the mesh: a physical group of a Gmsh file by its name, or by its number if it has no name (`"7"`); a file of
    /// `[mesh] files` by its name without extension. A set gives the nodes of its triangles, lines and points, or those of its tetrahedra
    /// if it has nothing else; a traction takes its triangles. `mesh info FILE` lists the sets of a file;
    /// `scale` and `refine` keep them.
    Set(String),
    /// `nodes`: nodes by their index from 0, such as `[0, 4, 7]`.
    Nodes(Vec<usize>),
    /// `faces`: triangles of the boundary by their nodes, such as `[[4, 0, 1], [4, 1, 5]]`.
    Faces(Vec<[usize; 3]>),
    /// `edges`: edges of a flat body's outline by their two ends, such as `[[0, 1], [1, 2]]`.
    Edges(Vec<[usize; 2]>),
}

/// A region of space.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// `on = "all"`: the whole mesh, or its whole boundary.
    All,
    /// `on = { axis, side, within }`: near a side of the mesh's bounding box.
    Side(SidePlane),
    /// `plane`: near the side of the smallest coordinate.
    Plane(Plane),
    /// `box`: inside a box.
    Box(BoxTable),
    /// `sphere`: inside a sphere.
    Sphere(SphereTable),
}

impl Selector {
    /// The key that names it in a scene file.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Region(Region::All | Region::Side(_)) => "on",
            Self::Region(Region::Plane(_)) => "plane",
            Self::Region(Region::Box(_)) => "box",
            Self::Region(Region::Sphere(_)) => "sphere",
            Self::Set(_) => "set",
            Self::Nodes(_) => "nodes",
            Self::Faces(_) => "faces",
            Self::Edges(_) => "edges",
        }
    }

    /// The selectors among the keys that every table with selectors has.
    pub(super) fn of_keys(
        on: &Option<On>,
        cuboid: &Option<BoxTable>,
        sphere: &Option<SphereTable>,
        set: &Option<String>,
    ) -> Vec<Self> {
        let on = on.clone().map(|on| match on {
            On::All => Region::All,
            On::Side(side) => Region::Side(side),
        });
        let (cuboid, sphere) = (cuboid.clone().map(Region::Box), sphere.clone().map(Region::Sphere));
        let regions = [on, cuboid, sphere].into_iter().flatten().map(Self::Region);
        regions.chain(set.clone().map(Self::Set)).collect()
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
