//! `[fixed]` and `[[prescribed]]`: nodes that do not move by themselves.

use std::f64::consts::TAU;

use nalgebra::{Rotation3, Vector3};
use serde::Deserialize;

use super::loads::SidePlane;
use super::{Axis, load};

/// `[fixed]`: nodes by a plane or by index.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// All nodes on one side of a plane.
    pub plane: Option<Plane>,
    /// These nodes.
    pub nodes: Option<Vec<usize>>,
}

/// All nodes whose coordinate is at most the mesh's smallest plus `below`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// Which coordinate.
    pub axis: Axis,
    /// Distance from the smallest coordinate of the mesh, m.
    pub below: f64,
}

/// `[[prescribed]]`: nodes that move as the scene says. `on` or `nodes`, and a displacement, a rotation, or both.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Prescribed {
    /// All nodes on one side of the mesh.
    pub on: Option<SidePlane>,
    /// These nodes.
    pub nodes: Option<Vec<usize>>,
    /// Where the nodes end, measured from where they were at rest, m.
    #[serde(default, deserialize_with = "load::three_numbers_if_any")]
    pub displacement: Option<[f64; 3]>,
    /// The coordinates that are prescribed; the others are free. All three where it is left out.
    pub components: Option<Vec<Axis>>,
    /// A turn about an axis, before the displacement.
    pub rotation: Option<Rotation>,
    /// Time in which the motion grows evenly from nothing to all of it, s; then it is held. Left out: all of it from the
    /// first step on. A static scene grows it with its load steps instead.
    pub over: Option<f64>,
}

/// A turn about a line that is parallel to a coordinate axis.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Rotation {
    /// The direction of the line.
    pub axis: Axis,
    /// A point of the line, m.
    #[serde(deserialize_with = "load::three_numbers")]
    pub center: [f64; 3],
    /// Full turns, counter-clockwise where the axis points at the eye.
    pub turns: f64,
}

impl Prescribed {
    /// Part of the motion that is done at a time (s): 0 at rest, 1 at the end.
    pub fn fraction(&self, time: f64) -> f64 {
        self.over.map_or(1.0, |over| (time / over).clamp(0.0, 1.0))
    }

    /// Where a node is when a part of the motion is done, m. `X` is its place at rest, m.
    ///
    /// x = c + R(2π · turns · fraction) (X − c) + fraction · displacement
    pub fn position(&self, X: &Vector3<f64>, fraction: f64) -> Vector3<f64> {
        let turned = self.rotation.as_ref().map_or(*X, |rotation| rotation.turn(X, fraction));
        turned + fraction * Vector3::from(self.displacement.unwrap_or_default())
    }

    /// Which of x, y and z are prescribed.
    pub fn holds(&self) -> [bool; 3] {
        let named = |axis| self.components.as_ref().is_none_or(|components| components.contains(&axis));
        [Axis::X, Axis::Y, Axis::Z].map(named)
    }
}

impl Rotation {
    fn turn(&self, X: &Vector3<f64>, fraction: f64) -> Vector3<f64> {
        let center = Vector3::from(self.center);
        let axis = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()][self.axis as usize];
        center + Rotation3::from_axis_angle(&axis, TAU * self.turns * fraction) * (X - center)
    }
}
