//! Volumes of tetrahedra.

use nalgebra::Vector3;

use super::TetrahedralMesh;

/// Volume of the tetrahedron (a, b, c, d), m³: `dot(cross(b − a, c − a), d − a) / 6`, negative when it is mirrored.
///
/// Only differences of positions enter, so a mesh far from the origin loses no more than its coordinates have lost already.
pub fn signed_volume([a, b, c, d]: [Vector3<f64>; 4]) -> f64 {
    (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
}

/// `v0  (m)` volume of each element, m³. Panics where an element's index is out of range: [`check`](super::check) comes first.
pub fn volumes(mesh: &TetrahedralMesh) -> Vec<f64> {
    mesh.elements.iter().map(|element| signed_volume(element.map(|i| mesh.vertices[i]))).collect()
}
