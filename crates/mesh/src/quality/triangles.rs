//! Size and shape of a triangle.

use nalgebra::Vector3;

use crate::area_vector;

/// One triangle's area (m²), smallest and largest angle (degrees), and circumradius over shortest edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleShape {
    pub area: f64,
    pub angles: [f64; 2],
    pub radius_to_edge: f64,
    pub is_flat: bool,
}

/// Measures a triangle.
pub(crate) fn measure(corners: [Vector3<f64>; 3]) -> TriangleShape {
    let sides = [0, 1, 2].map(|i| corners[(i + 1) % 3] - corners[i]);
    let lengths = sides.map(|side| side.norm());
    let twice_area = area_vector(corners).norm() * 2.0;
    let [shortest, longest] =
        [lengths.into_iter().fold(f64::INFINITY, f64::min), lengths.into_iter().fold(0.0, f64::max)];
    // The arc tangent keeps the digits of angles near 0° and 180°.
    let angles = [0, 1, 2].map(|i| twice_area.atan2(-sides[i].dot(&sides[(i + 2) % 3])).to_degrees());
    TriangleShape {
        area: 0.5 * twice_area,
        angles: [angles.into_iter().fold(f64::INFINITY, f64::min), angles.into_iter().fold(0.0, f64::max)],
        radius_to_edge: lengths.iter().product::<f64>() / (2.0 * twice_area * shortest),
        is_flat: !(twice_area > 8.0 * f64::EPSILON * longest * longest),
    }
}
