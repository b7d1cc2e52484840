//! Sizes and shapes of tetrahedra.

use std::f64::consts::PI;
use std::fmt;

use nalgebra::Vector3;

use super::{Extreme, extreme};
use crate::boundary::FACES;
use crate::connectivity::EDGES;
use crate::{TetrahedralMesh, area_vector, boundary, signed_volume};

/// Sizes and shapes of a mesh's elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of tetrahedra.
    pub elements: usize,
    /// Number of triangles on the boundary.
    pub boundary_faces: usize,
    /// Total volume, m³.
    pub volume: f64,
    /// Smallest and largest volume, m³.
    pub volumes: [Extreme; 2],
    /// Smallest height of a vertex above the opposite face, m. It limits the time step of explicit integrators.
    pub smallest_height: Extreme,
    /// Smallest and largest angle between two faces, degrees.
    pub dihedral_angles: [Extreme; 2],
    /// Smallest `3 r / R` of the inscribed and the circumscribed sphere: 1 for a regular tetrahedron, 0 for a flat one.
    pub radius_ratio: Extreme,
    /// Mean of `3 r / R` over the elements.
    pub mean_radius_ratio: f64,
}

/// Measures a mesh that has passed [`check`](crate::check).
pub fn quality(mesh: &TetrahedralMesh) -> Quality {
    let shapes: Vec<Shape> = mesh.elements.iter().map(|e| shape(e.map(|i| mesh.vertices[i]))).collect();
    let smallest = |value: fn(&Shape) -> f64| extreme(&shapes, value);
    let largest = |value: fn(&Shape) -> f64| extreme(&shapes, |shape| -value(shape)).negated();
    Quality {
        vertices: mesh.vertices.len(),
        elements: mesh.elements.len(),
        boundary_faces: boundary(mesh).len(),
        volume: shapes.iter().map(|shape| shape.volume).sum(),
        volumes: [smallest(|shape| shape.volume), largest(|shape| shape.volume)],
        smallest_height: smallest(|shape| shape.height),
        dihedral_angles: [smallest(|shape| least(&shape.angles)), largest(|shape| most(&shape.angles))],
        radius_ratio: smallest(|shape| shape.radius_ratio),
        mean_radius_ratio: shapes.iter().map(|shape| shape.radius_ratio).sum::<f64>() / shapes.len().max(1) as f64,
    }
}

/// Measures of one tetrahedron.
pub(super) struct Shape {
    /// m³
    pub volume: f64,
    /// Smallest height, m.
    pub height: f64,
    /// Dihedral angles, degrees.
    pub angles: [f64; 6],
    /// `3 r / R`
    pub radius_ratio: f64,
    /// Longest edge over `2 √6 r`.
    pub aspect_ratio: f64,
    /// Circumradius over shortest edge.
    pub radius_to_edge: f64,
}

/// Circumradius over shortest edge of a tetrahedron; infinite or NaN without volume.
pub fn tetrahedron_radius_to_edge(corners: [Vector3<f64>; 4]) -> f64 {
    shape(corners).radius_to_edge.abs()
}

/// Smallest and largest dihedral angle of a tetrahedron, degrees.
pub(crate) fn extreme_dihedral_angles(corners: [Vector3<f64>; 4]) -> [f64; 2] {
    let angles = dihedral_angles(FACES.map(|face| area_vector(face.map(|i| corners[i]))));
    [least(&angles), most(&angles)]
}

/// Measures a tetrahedron.
pub(super) fn shape(corners: [Vector3<f64>; 4]) -> Shape {
    let volume = signed_volume(corners);
    let normals = FACES.map(|face| area_vector(face.map(|i| corners[i])));
    let areas = normals.map(|normal| normal.norm());
    let edges = EDGES.map(|[i, j]| (corners[i] - corners[j]).norm());
    let inscribed = 3.0 * volume / areas.iter().sum::<f64>();
    let circumscribed = circumradius(corners, volume);
    Shape {
        volume,
        height: 3.0 * volume / most(&areas),
        angles: dihedral_angles(normals),
        radius_ratio: 3.0 * inscribed / circumscribed,
        aspect_ratio: most(&edges) / (24.0_f64.sqrt() * inscribed),
        radius_to_edge: circumscribed / least(&edges),
    }
}

/// The six dihedral angles, degrees, by the arc tangent: the arc cosine loses half of the digits near 0° and 180°.
fn dihedral_angles(normals: [Vector3<f64>; 4]) -> [f64; 6] {
    EDGES.map(|[i, j]| {
        let between = normals[i].cross(&normals[j]).norm().atan2(normals[i].dot(&normals[j]));
        (PI - between).to_degrees()
    })
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// `|a² (b×c) + b² (c×a) + c² (a×b)| / (12 V)` with a, b, c the edges from one vertex.
fn circumradius([o, a, b, c]: [Vector3<f64>; 4], volume: f64) -> f64 {
    let (a, b, c) = (a - o, b - o, c - o);
    let sum = b.cross(&c) * a.norm_squared() + c.cross(&a) * b.norm_squared() + a.cross(&b) * c.norm_squared();
    sum.norm() / (12.0 * volume)
}

impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<26}{:>12}", "vertices", self.vertices)?;
        writeln!(f, "{:<26}{:>12}", "tetrahedra", self.elements)?;
        writeln!(f, "{:<26}{:>12}", "boundary triangles", self.boundary_faces)?;
        writeln!(f, "{:<26}{:>12.6e}", "volume, m³", self.volume)?;
        writeln!(f, "{:<26}{:>12.4}", "mean radius ratio (0…1)", self.mean_radius_ratio)?;
        writeln!(f, "{:<26}{:>12}{:>12}", "", "", "element")?;
        let length = |extreme: Extreme| (format!("{:.4e}", extreme.value), extreme.element);
        let plain = |extreme: Extreme| (format!("{:.4}", extreme.value), extreme.element);
        let rows = [
            ("smallest volume, m³", length(self.volumes[0])),
            ("largest volume, m³", length(self.volumes[1])),
            ("smallest height, m", length(self.smallest_height)),
            ("smallest dihedral angle, °", plain(self.dihedral_angles[0])),
            ("largest dihedral angle, °", plain(self.dihedral_angles[1])),
            ("worst radius ratio (0…1)", plain(self.radius_ratio)),
        ];
        rows.iter().try_for_each(|(name, (value, element))| writeln!(f, "{name:<26}{value:>12}{element:>12}"))
    }
}
