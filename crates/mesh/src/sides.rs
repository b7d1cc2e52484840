//! The sides of a mesh's bounding box: the nodes near them.

use nalgebra::Vector3;
use serde::Deserialize;

/// One of the two sides of a mesh's bounding box along an axis.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The side of the smallest coordinate.
    Min,
    /// The side of the largest coordinate.
    Max,
}

/// Vertices within a distance (m) of one side of a mesh, along `axis` 0, 1 or 2, ascending. The distance is inclusive.
pub fn nodes_on_side(vertices: &[Vector3<f64>], axis: usize, side: Side, within: f64) -> Vec<usize> {
    let sign = match side {
        Side::Min => 1.0,
        Side::Max => -1.0,
    };
    let coordinate = |node: usize| sign * vertices[node][axis];
    let all = 0..vertices.len();
    let smallest = all.clone().map(coordinate).fold(f64::INFINITY, f64::min);
    all.filter(|&node| coordinate(node) <= smallest + within).collect()
}
