//! Sizes and shapes of triangles, in the plane or in space.

use std::fmt;

use nalgebra::Vector3;

use super::{Extreme, extreme, quantile};
use crate::connectivity::edges;
use crate::{Mesh, area_vector};

/// Sizes and shapes of a mesh's triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleQuality {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Total area, m².
    pub area: f64,
    /// Smallest and largest area, m².
    pub areas: [Extreme; 2],
    /// Length of the shortest and of the longest edge, m.
    pub edges: [f64; 2],
    /// Mean length of an edge, m.
    pub mean_edge: f64,
    /// Smallest and largest angle, degrees.
    pub angles: [Extreme; 2],
    /// Largest circumradius over shortest edge. It is 1 / (2 sin θ) with the smallest angle θ, and 1/√3 for an equilateral triangle.
    pub radius_to_edge: Extreme,
    /// Circumradius over shortest edge that 99 % of the triangles do not exceed.
    pub radius_to_edge_99: f64,
    /// Median of circumradius over shortest edge.
    pub median_radius_to_edge: f64,
}

/// Measures the triangles of a mesh in the plane or in space. Indices have to be in range. Lengths and angles of a mesh without
/// triangles are infinite, its medians NaN.
///
/// ```
/// use fem_mesh::{Mesh, triangle_quality};
/// use nalgebra::Vector2;
///
/// let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vector2::from);
/// let square = triangle_quality(&Mesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]]));
/// assert!((square.radius_to_edge.value - 0.5_f64.sqrt()).abs() < 1e-15);
/// ```
pub fn triangle_quality<const D: usize>(mesh: &Mesh<D, 3>) -> TriangleQuality {
    let place = |vertex: usize| Vector3::from_fn(|i, _| if i < D { mesh.vertices[vertex][i] } else { 0.0 });
    let shapes: Vec<TriangleShape> = mesh.elements.iter().map(|element| measure(element.map(place))).collect();
    let smallest = |value: fn(&TriangleShape) -> f64| extreme(&shapes, value);
    let largest = |value: fn(&TriangleShape) -> f64| extreme(&shapes, |shape| -value(shape)).negated();
    let mut ratios: Vec<f64> = shapes.iter().map(|shape| shape.radius_to_edge).collect();
    ratios.sort_unstable_by(f64::total_cmp);
    let length = |&[a, b]: &[usize; 2]| (mesh.vertices[a] - mesh.vertices[b]).norm();
    let lengths: Vec<f64> = edges(&mesh.elements).iter().map(length).collect();
    TriangleQuality {
        vertices: mesh.vertices.len(),
        triangles: mesh.elements.len(),
        area: shapes.iter().map(|shape| shape.area).sum(),
        areas: [smallest(|shape| shape.area), largest(|shape| shape.area)],
        edges: [lengths.iter().copied().fold(f64::INFINITY, f64::min), lengths.iter().copied().fold(0.0, f64::max)],
        mean_edge: lengths.iter().sum::<f64>() / lengths.len() as f64,
        angles: [smallest(|shape| shape.angles[0]), largest(|shape| shape.angles[1])],
        radius_to_edge: largest(|shape| shape.radius_to_edge),
        radius_to_edge_99: quantile(&ratios, 0.99),
        median_radius_to_edge: quantile(&ratios, 0.5),
    }
}

/// Circumradius over shortest edge of a triangle; infinite or NaN without area.
pub fn triangle_radius_to_edge(corners: [Vector3<f64>; 3]) -> f64 {
    measure(corners).radius_to_edge
}

/// One triangle's area (m²), smallest and largest angle (degrees), and circumradius over shortest edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleShape {
    pub area: f64,
    pub angles: [f64; 2],
    pub radius_to_edge: f64,
    /// Without area within rounding.
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

impl fmt::Display for TriangleQuality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = [
            ("vertices", self.vertices.to_string()),
            ("triangles", self.triangles.to_string()),
            ("area, m²", format!("{:.6e}", self.area)),
            ("shortest edge, m", format!("{:.4e}", self.edges[0])),
            ("mean edge, m", format!("{:.4e}", self.mean_edge)),
            ("longest edge, m", format!("{:.4e}", self.edges[1])),
            ("median circumradius / edge", format!("{:.4}", self.median_radius_to_edge)),
            ("99 % of circumradius / edge", format!("{:.4}", self.radius_to_edge_99)),
        ];
        rows.iter().try_for_each(|(name, figure)| writeln!(f, "{name:<28}{figure:>12}"))?;
        writeln!(f, "{:<28}{:>12}{:>12}", "", "", "element")?;
        let rows = [
            ("worst circumradius / edge", format!("{:.4}", self.radius_to_edge.value), self.radius_to_edge.element),
            ("smallest angle, °", format!("{:.4}", self.angles[0].value), self.angles[0].element),
            ("largest angle, °", format!("{:.4}", self.angles[1].value), self.angles[1].element),
            ("smallest area, m²", format!("{:.4e}", self.areas[0].value), self.areas[0].element),
            ("largest area, m²", format!("{:.4e}", self.areas[1].value), self.areas[1].element),
        ];
        rows.iter().try_for_each(|(name, value, element)| writeln!(f, "{name:<28}{value:>12}{element:>12}"))
    }
}
