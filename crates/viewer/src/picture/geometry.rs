//! Points, boxes and triangles in single precision, the format of the graphics card.

use std::collections::BTreeSet;

use kiss3d::glamx::Vec3;
use nalgebra::{DVector, Vector3};

/// An axis-aligned bounding box, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates.
    pub low: Vec3,
    /// Largest coordinates.
    pub high: Vec3,
}

impl Bounds {
    /// Bounding box of the finite points; the unit cube about the origin if there are none.
    pub fn of(points: &[Vec3]) -> Self {
        let mut finite = points.iter().copied().filter(|p| p.is_finite());
        let Some(first) = finite.next() else {
            return Bounds { low: Vec3::splat(-0.5), high: Vec3::splat(0.5) };
        };
        let grow = |b: Bounds, p: Vec3| Bounds { low: b.low.min(p), high: b.high.max(p) };
        finite.fold(Bounds { low: first, high: first }, grow)
    }

    /// Bounding box of both boxes.
    pub fn joined(&self, other: &Self) -> Self {
        Bounds { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Centre of the box, m.
    pub fn centre(&self) -> Vec3 {
        (self.low + self.high) / 2.0
    }

    /// Half of the diagonal, m; never zero.
    pub fn radius(&self) -> f32 {
        ((self.high - self.low).length() / 2.0).max(1e-6)
    }

    /// The eight corners, m.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let side = |bit: usize, low: f32, high: f32| if i >> bit & 1 == 0 { low } else { high };
            Vec3::new(
                side(0, self.low.x, self.high.x),
                side(1, self.low.y, self.high.y),
                side(2, self.low.z, self.high.z),
            )
        })
    }
}

/// Converts a point to single precision.
pub fn single(point: &Vector3<f64>) -> Vec3 {
    Vec3::new(point.x as f32, point.y as f32, point.z as f32)
}

/// Converts a point to double precision.
pub fn double(point: Vec3) -> Vector3<f64> {
    Vector3::new(f64::from(point.x), f64::from(point.y), f64::from(point.z))
}

/// Converts stacked positions `[x0 y0 z0 x1 …]` to points.
pub fn points(q: &DVector<f64>) -> Vec<Vec3> {
    q.as_slice().chunks_exact(3).map(|p| Vec3::new(p[0] as f32, p[1] as f32, p[2] as f32)).collect()
}

/// Converts the indices of triangles to 32 bits.
pub fn faces(triangles: &[[usize; 3]]) -> Vec<[u32; 3]> {
    triangles.iter().map(|t| t.map(|i| i as u32)).collect()
}

/// Two unit vectors at right angles to `up`: to the right and to the front. They are x and z
/// where y is up, and x and −y where z is up.
pub fn level_axes(up: Vec3) -> (Vec3, Vec3) {
    let hint = if up.x.abs() < 0.9 { Vec3::X } else { Vec3::Z };
    let front = hint.cross(up).normalize();
    (up.cross(front), front)
}

/// Edges of the triangles, each once.
pub fn edges(triangles: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let sides = |t: &[usize; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[a, b]| [a.min(b), a.max(b)]);
    triangles.iter().flat_map(sides).collect::<BTreeSet<_>>().into_iter().collect()
}

/// Unit normals of the vertices: the mean of the triangles around each, weighted by area.
pub fn smooth_normals(points: &[Vec3], faces: &[[u32; 3]]) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; points.len()];
    for face in faces {
        let [a, b, c] = face.map(|i| points[i as usize]);
        let twice_area = (b - a).cross(c - a);
        for &i in face {
            normals[i as usize] += twice_area;
        }
    }
    normals.into_iter().map(|n| n.normalize_or(Vec3::Y)).collect()
}

/// The number of the first triangle that a ray meets, and the distance along the ray, m.
pub fn first_hit(origin: Vec3, ray: Vec3, points: &[Vec3], triangles: &[[usize; 3]]) -> Option<(usize, f32)> {
    let hit =
        |(number, t): (usize, &[usize; 3])| Some((number, distance_to_triangle(origin, ray, t.map(|i| points[i]))?));
    triangles.iter().enumerate().filter_map(hit).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Barycentric coordinate beyond an edge up to which a ray still meets a triangle, so that rounding errors leave no gaps between triangles.
const BEYOND_EDGE: f32 = -1e-5;

/// Möller and Trumbore's intersection test, from either side of the triangle.
fn distance_to_triangle(origin: Vec3, ray: Vec3, [a, b, c]: [Vec3; 3]) -> Option<f32> {
    let (ab, ac) = (b - a, c - a);
    let p = ray.cross(ac);
    let determinant = ab.dot(p);
    let s = origin - a;
    let u = s.dot(p) / determinant;
    let q = s.cross(ab);
    let v = ray.dot(q) / determinant;
    let distance = ac.dot(q) / determinant;
    // A ray in the triangle's plane gives NaN or infinity, which fail these comparisons.
    let meets = [1.0 - u - v, u, v].iter().all(|coordinate| *coordinate >= BEYOND_EDGE);
    Some(distance).filter(|distance| meets && *distance > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn a_ray_meets_the_nearer_of_two_triangles() {
        let points: Vec<Vec3> = TRIANGLE.into_iter().chain(TRIANGLE.map(|p| p + Vec3::Z)).collect();
        let hit = first_hit(Vec3::new(0.2, 0.2, 5.0), -Vec3::Z, &points, &[[0, 1, 2], [3, 4, 5]]);
        assert_eq!(hit, Some((1, 4.0)));
    }

    #[test]
    fn a_ray_through_a_corner_of_many_triangles_meets_one_of_them() {
        let fan: Vec<Vec3> =
            (0..7).map(|i| Vec3::new((i as f32).cos(), (i as f32).sin(), 0.0)).chain([Vec3::ZERO]).collect();
        let triangles: Vec<[usize; 3]> = (0..6).map(|i| [7, i, i + 1]).collect();
        for i in 0..100 {
            let origin = Vec3::new(0.37 * i as f32, 5.0 - 0.11 * i as f32, 3.0);
            assert!(first_hit(origin, (-origin).normalize(), &fan, &triangles).is_some(), "{origin}");
        }
    }

    #[test]
    fn a_ray_beside_a_triangle_or_in_its_plane_misses() {
        assert_eq!(first_hit(Vec3::new(0.8, 0.8, 5.0), -Vec3::Z, &TRIANGLE, &[[0, 1, 2]]), None);
        assert_eq!(first_hit(Vec3::new(-1.0, 0.2, 0.0), Vec3::X, &TRIANGLE, &[[0, 1, 2]]), None);
    }

    #[test]
    fn normals_point_out_of_counter_clockwise_triangles() {
        assert_eq!(smooth_normals(&TRIANGLE, &[[0, 1, 2]]), vec![Vec3::Z; 3]);
    }

    #[test]
    fn a_vertex_without_area_still_has_a_unit_normal() {
        assert_eq!(smooth_normals(&[Vec3::ZERO; 3], &[[0, 1, 2]]), vec![Vec3::Y; 3]);
    }

    #[test]
    fn an_edge_of_two_triangles_counts_once() {
        assert_eq!(edges(&[[0, 1, 2], [2, 1, 3]]).len(), 5);
    }

    #[test]
    fn bounds_ignore_points_that_are_not_finite() {
        let bounds = Bounds::of(&[Vec3::ZERO, Vec3::ONE, Vec3::splat(f32::NAN)]);
        assert_eq!((bounds.low, bounds.high), (Vec3::ZERO, Vec3::ONE));
    }
}
