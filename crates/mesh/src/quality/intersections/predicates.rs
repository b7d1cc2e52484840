//! Tests whether two triangles in space have a common point, by exact signs of determinants: Shewchuk, Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates (1997).

use nalgebra::Vector3;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// A point, m.
type Point = Vector3<f64>;

/// A triangle with corners that are not on one line, and an axis along which its shadow has an area.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    corners: [Point; 3],
    axis: usize,
}

impl Triangle {
    /// A triangle; `None` if its corners lie on one line exactly, or are not finite.
    pub fn new(corners: [Point; 3]) -> Option<Self> {
        let is_finite = corners.iter().flatten().all(|x| x.is_finite());
        let axis = (0..3).find(|&axis| turn(corners, axis) != 0)?;
        is_finite.then_some(Self { corners, axis })
    }

    /// Side of the triangle's plane on which a point lies, or 0 in the plane.
    fn side(&self, point: &Point) -> i8 {
        let [a, b, c] = &self.corners;
        side([a, b, c], point)
    }

    fn edges(&self) -> [[usize; 2]; 3] {
        [[0, 1], [1, 2], [2, 0]]
    }

    /// Returns true if the segment between two points, whose sides are given, meets the triangle.
    fn meets(&self, [p, q]: [&Point; 2], sides: [i8; 2]) -> bool {
        match sides {
            [0, 0] => self.meets_in_plane([p, q]),
            [a, b] if a == b => false,
            _ => {
                let [a, b, c] = &self.corners;
                let turns = [[a, b], [b, c], [c, a]].map(|[from, to]| side([p, q, from], to));
                turns.iter().all(|&turn| turn >= 0) || turns.iter().all(|&turn| turn <= 0)
            }
        }
    }

    /// The same for two points in the triangle's plane.
    fn meets_in_plane(&self, [p, q]: [&Point; 2]) -> bool {
        let (axis, corners) = (self.axis, self.corners);
        let sign = turn(corners, axis);
        let contains =
            |x: &Point| self.edges().iter().all(|&[i, j]| turn([corners[i], corners[j], *x], axis) * sign >= 0);
        contains(p)
            || contains(q)
            || self.edges().iter().any(|&[i, j]| segments_meet([p, q], [&corners[i], &corners[j]], axis))
    }
}

/// Returns true if two triangles without a common corner have a common point.
pub fn meet(a: &Triangle, b: &Triangle) -> bool {
    let sides = b.corners.map(|x| a.side(&x));
    if is_apart(sides) {
        return false;
    }
    let others = a.corners.map(|x| b.side(&x));
    if is_apart(others) {
        return false;
    }
    // The ends of the common segment, or the corners of the common polygon, lie on an edge of one of the two.
    let edge = |of: &Triangle, sides: [i8; 3], on: &Triangle| {
        of.edges().iter().any(|&[i, j]| on.meets([&of.corners[i], &of.corners[j]], [sides[i], sides[j]]))
    };
    edge(b, sides, a) || edge(a, others, b)
}

/// Returns true if the segment between two points meets a triangle.
pub fn segment_meets([p, q]: [&Point; 2], triangle: &Triangle) -> bool {
    triangle.meets([p, q], [triangle.side(p), triangle.side(q)])
}

/// Returns true if two triangles whose corners `i` and `j` are one point have another common point.
pub fn meet_beyond_corner(a: &Triangle, i: usize, b: &Triangle, j: usize) -> bool {
    // From the common corner to another common point and on, one leaves the first of the two through the opposite edge.
    let opposite = |of: &Triangle, k: usize, on: &Triangle| {
        let [p, q] = [&of.corners[(k + 1) % 3], &of.corners[(k + 2) % 3]];
        on.meets([p, q], [on.side(p), on.side(q)])
    };
    opposite(a, i, b) || opposite(b, j, a)
}

/// Returns true if two triangles with a common edge have a common point off it: they lie in one plane, on one side of the edge. `i` and
/// `j` are the corners opposite to the edge.
pub fn meet_beyond_edge(a: &Triangle, i: usize, b: &Triangle, j: usize) -> bool {
    let [p, q] = [a.corners[(i + 1) % 3], a.corners[(i + 2) % 3]];
    let of = |apex: Point| turn([p, q, apex], a.axis);
    a.side(&b.corners[j]) == 0 && of(a.corners[i]) == of(b.corners[j])
}

fn is_apart(sides: [i8; 3]) -> bool {
    sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2]
}

/// Returns true if two segments of one plane have a common point, seen along an axis that the plane does not contain.
fn segments_meet([p, q]: [&Point; 2], [a, b]: [&Point; 2], axis: usize) -> bool {
    let of = |x: &Point, y: &Point, z: &Point| turn([*x, *y, *z], axis);
    let (pa, pb, ap, aq) = (of(p, q, a), of(p, q, b), of(a, b, p), of(a, b, q));
    if [pa, pb, ap, aq] == [0; 4] {
        // All on one line, and a point is between two others if it is so in every coordinate.
        let between =
            |x: &Point, p: &Point, q: &Point| (0..3).all(|i| p[i].min(q[i]) <= x[i] && x[i] <= p[i].max(q[i]));
        return between(a, p, q) || between(b, p, q) || between(p, a, b);
    }
    pa * pb <= 0 && ap * aq <= 0
}

/// Side of the plane through three points on which a fourth lies.
fn side([a, b, c]: [&Point; 3], d: &Point) -> i8 {
    let place = |p: &Point| Coord3D { x: p.x, y: p.y, z: p.z };
    sign(orient3d(place(a), place(b), place(c), place(d)))
}

/// Returns whether three points turn left (1) or right (−1) seen along an axis, or lie on one line (0).
fn turn(corners: [Point; 3], axis: usize) -> i8 {
    let [a, b, c] = corners.map(|p| Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] });
    sign(orient2d(a, b, c))
}

fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}
