//! Areas and volumes of single elements.

use nalgebra::Vector3;

use super::TetrahedralMesh;

/// Volume of the tetrahedron (a, b, c, d), m³: `dot(cross(b − a, c − a), d − a) / 6`, negative for a mirrored tetrahedron.
///
/// It is computed from differences of positions, so a mesh far from the origin loses no digits beyond those of its coordinates.
pub fn signed_volume([a, b, c, d]: [Vector3<f64>; 4]) -> f64 {
    (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
}

/// `v0  (m)` signed volume of each element, m³. Panics if an element's index is out of range, as it never is after [`check`](super::check).
pub fn volumes(mesh: &TetrahedralMesh) -> Vec<f64> {
    mesh.elements.iter().map(|element| signed_volume(element.map(|i| mesh.vertices[i]))).collect()
}

/// Area of the triangle (a, b, c) times its unit normal, m²; outward if the corners are counter-clockwise from outside.
pub fn area_vector([a, b, c]: [Vector3<f64>; 3]) -> Vector3<f64> {
    0.5 * (b - a).cross(&(c - a))
}
