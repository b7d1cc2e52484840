//! Shape of one tetrahedron, and the bounds that no element may leave.

use nalgebra::Vector3;

use crate::boundary::FACES;
use crate::connectivity::EDGES;

/// Difference of measures beyond rounding.
const MARGIN: f64 = 1e-12;

/// Measures of a tetrahedron that improvement compares; each without trigonometry.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Smallest sine of a dihedral angle: small for angles close to 0° and close to 180°. Negative for an inverted tetrahedron.
    pub sine: f64,
    /// Cosine of the smallest and of the largest dihedral angle.
    pub cosines: [f64; 2],
    /// `3 r / R` of the inscribed and the circumscribed sphere.
    pub radius_ratio: f64,
    /// Shortest edge over circumradius.
    pub edge_to_radius: f64,
}

impl Shape {
    /// Measures the tetrahedron of four corners, m.
    pub fn new(corners: [Vector3<f64>; 4]) -> Self {
        let [o, a, b, c] = corners;
        let (a, b, c) = (a - o, b - o, c - o);
        let (bc, ca, ab) = (b.cross(&c), c.cross(&a), a.cross(&b));
        let six_volumes = a.dot(&bc);
        let normals = FACES.map(|[i, j, k]| (corners[j] - corners[i]).cross(&(corners[k] - corners[i])));
        let areas = normals.map(|normal| normal.norm());
        let (mut cosines, mut sine) = ([-1.0_f64, 1.0_f64], f64::INFINITY);
        let mut shortest = f64::INFINITY;
        for [i, j] in EDGES {
            // The faces opposite two corners meet in the edge of the other two.
            let product = areas[i] * areas[j];
            let cosine = -normals[i].dot(&normals[j]) / product;
            cosines = [cosines[0].max(cosine), cosines[1].min(cosine)];
            let length = (corners[j] - corners[i]).norm();
            shortest = shortest.min(length);
            let [k, l] = other_corners(i, j);
            sine = sine.min(six_volumes * (corners[l] - corners[k]).norm() / product);
        }
        let around = bc * a.norm_squared() + ca * b.norm_squared() + ab * c.norm_squared();
        let radius = around.norm() / (2.0 * six_volumes);
        let inscribed = six_volumes / areas.iter().sum::<f64>();
        if !(six_volumes > 0.0 && sine.is_finite() && radius.is_finite()) {
            return Self { sine: -1.0, cosines: [1.0, -1.0], radius_ratio: -1.0, edge_to_radius: -1.0 };
        }
        Self { sine, cosines, radius_ratio: 3.0 * inscribed / radius, edge_to_radius: shortest / radius }
    }
}

fn other_corners(i: usize, j: usize) -> [usize; 2] {
    let mut others = (0..4).filter(|&k| k != i && k != j);
    [others.next().unwrap_or(0), others.next().unwrap_or(0)]
}

/// The worst of each measure over a mesh. A change is refused if an element would be worse in any of them.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    cosines: [f64; 2],
    radius_ratio: f64,
    edge_to_radius: f64,
}

impl Floor {
    /// Bounds of the dihedral angles alone, degrees.
    pub fn within(angles: [f64; 2]) -> Self {
        Self { cosines: angles.map(|angle| angle.to_radians().cos()), radius_ratio: 0.0, edge_to_radius: 0.0 }
    }

    /// The worst of some shapes.
    pub fn of(shapes: impl Iterator<Item = Shape>) -> Self {
        let best = Self { cosines: [-1.0, 1.0], radius_ratio: 1.0, edge_to_radius: f64::INFINITY };
        shapes.fold(best, |floor, shape| Self {
            cosines: [floor.cosines[0].max(shape.cosines[0]), floor.cosines[1].min(shape.cosines[1])],
            radius_ratio: floor.radius_ratio.min(shape.radius_ratio),
            edge_to_radius: floor.edge_to_radius.min(shape.edge_to_radius),
        })
    }

    /// Returns true if every quality measure of the element is better than the worst one, by more than rounding.
    pub fn admits(&self, shape: &Shape) -> bool {
        shape.sine > 0.0
            && shape.cosines[0] < self.cosines[0] - MARGIN
            && shape.cosines[1] > self.cosines[1] + MARGIN
            && shape.radius_ratio > self.radius_ratio * (1.0 + MARGIN)
            && shape.edge_to_radius > self.edge_to_radius * (1.0 + MARGIN)
    }
}

/// Energy of optimal Delaunay triangulation of one tetrahedron, m⁵: the integral over it of the linear interpolant of |x|² less |x|²,
/// `V / ((d + 1)(d + 2)) Σ l²` over its edges with d = 3.
pub fn energy(corners: [Vector3<f64>; 4]) -> f64 {
    let [o, a, b, c] = corners;
    let squares: f64 = EDGES.iter().map(|&[i, j]| (corners[j] - corners[i]).norm_squared()).sum();
    (a - o).cross(&(b - o)).dot(&(c - o)) / 6.0 / 20.0 * squares
}
