//! Parts of a mesh's surface, and what a force that is spread over them does to the nodes.

use nalgebra::{SMatrix, Vector3};
use serde::Deserialize;

/// One of two opposite sides of a mesh.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Smallest coordinate.
    Min,
    /// Largest coordinate.
    Max,
}

/// The triangles that lie within a distance (m) of one side of a mesh, along `axis` 0, 1 or 2: all of their corners do.
pub fn faces_on_side(
    vertices: &[Vector3<f64>],
    faces: &[[usize; 3]],
    axis: usize,
    side: Side,
    within: f64,
) -> Vec<[usize; 3]> {
    let mut is_on_side = vec![false; vertices.len()];
    nodes_on_side(vertices, axis, side, within).into_iter().for_each(|node| is_on_side[node] = true);
    faces.iter().filter(|face| face.iter().all(|&node| is_on_side[node])).copied().collect()
}

/// The vertices that lie within a distance (m) of one side of a mesh, ascending.
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

/// Area of a triangle times its outward unit normal, m².
pub fn area_vector([a, b, c]: [Vector3<f64>; 3]) -> Vector3<f64> {
    0.5 * (b - a).cross(&(c - a))
}

/// Nodal forces of an even traction (Pa) on undeformed triangles: every corner takes a third of a triangle's area, which is
/// exact for linear shape functions. One entry for each node that has a share, ascending; N.
pub fn traction_forces(
    vertices: &[Vector3<f64>],
    faces: &[[usize; 3]],
    traction: &Vector3<f64>,
) -> Vec<(usize, Vector3<f64>)> {
    spread(faces, |face| traction * area_vector(face.map(|node| vertices[node])).norm())
}

/// Nodal forces of a pressure (Pa) on triangles where they are now, N: −p times a third of each triangle's area vector. One
/// entry for each node that has a share, ascending. `positions` holds every node's place now, m.
pub fn pressure_forces(positions: &[Vector3<f64>], faces: &[[usize; 3]], pressure: f64) -> Vec<(usize, Vector3<f64>)> {
    spread(faces, |face| -pressure * area_vector(face.map(|node| positions[node])))
}

/// Derivatives of [`pressure_forces`], N/m: for each triangle the derivative of its nine forces by its nine coordinates, both
/// corner by corner. With n = (b − a) × (c − a), each corner's force is −p n / 6, and
/// ∂n/∂a = [c − b]×, ∂n/∂b = [a − c]×, ∂n/∂c = [b − a]×.
///
/// Their sum is symmetric where the loaded surface is closed or its rim is held, else not.
pub fn pressure_stiffness(
    positions: &[Vector3<f64>],
    faces: &[[usize; 3]],
    pressure: f64,
) -> impl Iterator<Item = ([usize; 3], SMatrix<f64, 9, 9>)> {
    faces.iter().map(move |&face| {
        let [a, b, c] = face.map(|node| positions[node]);
        let mut block = SMatrix::<f64, 9, 9>::zeros();
        for (corner, edge) in [c - b, a - c, b - a].into_iter().enumerate() {
            let derivative = edge.cross_matrix() * (-pressure / 6.0);
            for row in 0..3 {
                block.fixed_view_mut::<3, 3>(3 * row, 3 * corner).copy_from(&derivative);
            }
        }
        (face, block)
    })
}

fn spread(faces: &[[usize; 3]], force: impl Fn(&[usize; 3]) -> Vector3<f64>) -> Vec<(usize, Vector3<f64>)> {
    let mut shares: Vec<_> = faces.iter().flat_map(|face| face.map(|node| (node, force(face) / 3.0))).collect();
    // Stable, so that sums are the same in every run.
    shares.sort_by_key(|share| share.0);
    let equal = shares.chunk_by(|a, b| a.0 == b.0);
    equal.map(|equal| (equal[0].0, equal.iter().map(|share| share.1).sum())).collect()
}
