//! Self-intersections of surfaces, beside integer arithmetic.

use fem_mesh::{Pattern, SelfIntersections, SurfaceMesh, boundary, box_mesh, self_intersections};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::fixed_seed;

fn surface(vertices: &[[i64; 3]], elements: &[[usize; 3]]) -> SurfaceMesh {
    let places = vertices.iter().map(|x| Vector3::from(x.map(|x| x as f64))).collect();
    SurfaceMesh::new(places, elements.to_vec())
}

/// Corners of a polygon: the part of a triangle that lies in another, cut by rational arithmetic in integers. Whether two triangles have a
/// common point off some points is found by brute force: the common part of two triangles is a polygon whose corners are corners of one in
/// the other, or intersections of an edge with a triangle or with an edge; each is compared with the shared corners.
mod brute_force {
    type Place = [i128; 3];

    /// A point with a common denominator above zero.
    type Fraction = ([i128; 3], i128);

    fn minus(a: Place, b: Place) -> Place {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    fn cross(a: Place, b: Place) -> Place {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    fn dot(a: Place, b: Place) -> i128 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    fn normal([a, b, c]: [Place; 3]) -> Place {
        cross(minus(b, a), minus(c, a))
    }

    fn scaled(a: Place, by: i128) -> Place {
        a.map(|x| x * by)
    }

    /// Returns true if a point lies in a triangle.
    fn contains(triangle: [Place; 3], (point, denominator): Fraction) -> bool {
        let n = normal(triangle);
        let away = |i: usize| minus(point, scaled(triangle[i], denominator));
        let is_left = |i: usize| dot(cross(minus(triangle[(i + 1) % 3], triangle[i]), away(i)), n) >= 0;
        dot(n, away(0)) == 0 && (0..3).all(is_left)
    }

    /// Points that a segment has in common with a triangle, or with its edges if it lies in the triangle's plane.
    fn on_segment([p, q]: [Place; 2], triangle: [Place; 3], found: &mut Vec<Fraction>) {
        let n = normal(triangle);
        let (above, below) = (dot(n, minus(p, triangle[0])), dot(n, minus(q, triangle[0])));
        let planes: Vec<(i128, i128)> = if (above, below) == (0, 0) {
            // Planes through the edges, at right angles to the triangle.
            let edge = |i: usize| {
                let m = cross(minus(triangle[(i + 1) % 3], triangle[i]), n);
                (dot(m, minus(p, triangle[i])), dot(m, minus(q, triangle[i])))
            };
            (0..3).map(edge).collect()
        } else {
            vec![(above, below)]
        };
        let mut points = vec![(p, 1), (q, 1)];
        for (a, b) in planes.into_iter().filter(|(a, b)| a != b && (a.signum() * b.signum()) <= 0) {
            // p + (q − p) a / (a − b)
            let (a, whole) = if a > b { (a, a - b) } else { (-a, b - a) };
            let place = [0, 1, 2].map(|i| p[i] * whole + (q[i] - p[i]) * a);
            points.push((place, whole));
        }
        found.extend(points.into_iter().filter(|&point| contains(triangle, point)));
    }

    /// Returns true if two triangles have a common point off their shared corners and edges.
    pub fn cross_each_other(a: [Place; 3], b: [Place; 3]) -> bool {
        let shared: Vec<Place> = a.into_iter().filter(|x| b.contains(x)).collect();
        let mut found = Vec::new();
        for (of, on) in [(a, b), (b, a)] {
            (0..3).for_each(|i| on_segment([of[i], of[(i + 1) % 3]], on, &mut found));
        }
        let is_shared = |&(point, denominator): &Fraction| match shared[..] {
            [] => false,
            [x] => point == scaled(x, denominator),
            // On the shared edge: along it, and between its ends by convexity.
            [x, y, ..] => cross(minus(point, scaled(x, denominator)), minus(y, x)) == [0; 3],
        };
        shared.len() == 3 || found.iter().any(|point| !is_shared(point))
    }

    pub fn is_flat(triangle: [Place; 3]) -> bool {
        normal(triangle) == [0; 3]
    }
}

/// All pairs by brute force.
fn all_pairs(vertices: &[[i64; 3]], elements: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let corners = |i: usize| elements[i].map(|corner| vertices[corner].map(i128::from));
    let solid: Vec<usize> = (0..elements.len()).filter(|&i| !brute_force::is_flat(corners(i))).collect();
    let mut pairs = Vec::new();
    for (k, &i) in solid.iter().enumerate() {
        for &j in &solid[k + 1..] {
            if brute_force::cross_each_other(corners(i), corners(j)) {
                pairs.push([i, j]);
            }
        }
    }
    pairs
}

proptest! {
    #![proptest_config(fixed_seed(3000))]

    // Few places, so that triangles touch, share corners and edges, and lie in one plane.
    #[test]
    fn crossings_are_those_of_integer_arithmetic(
        size in 2_i64..6,
        places in proptest::collection::vec([0_i64..1000, 0_i64..1000, 0_i64..1000], 12),
        is_plane in any::<bool>(),
        elements in proptest::collection::vec([0_usize..12, 0_usize..12, 0_usize..12], 2..10),
    ) {
        let place = |x: &[i64; 3]| [x[0] % size, x[1] % size, if is_plane { x[0] % size } else { x[2] % size }];
        let vertices: Vec<[i64; 3]> = places.iter().map(place).collect();
        let expected = all_pairs(&vertices, &elements);
        let found = self_intersections(&surface(&vertices, &elements));
        prop_assert_eq!(found.count, expected.len());
        prop_assert_eq!(found.first, expected.first().copied());
        prop_assert!(!found.has_more);
    }

}

proptest! {
    #![proptest_config(fixed_seed(30))]

    // Many triangles in a large box, so that the tree has to leave pairs out.
    #[test]
    fn the_tree_misses_no_pair(places in proptest::collection::vec([0_i64..400, 0_i64..400, 0_i64..400], 120), reach in 1_i64..200) {
        let corner = |i: usize, k: usize| {
            let x = places[(i + 7 * k) % places.len()];
            [0, 1, 2].map(|axis| places[i][axis] + (x[axis] % reach))
        };
        let vertices: Vec<[i64; 3]> = (0..places.len()).flat_map(|i| [0, 1, 2].map(|k| corner(i, k))).collect();
        let elements: Vec<[usize; 3]> = (0..places.len()).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        prop_assert_eq!(self_intersections(&surface(&vertices, &elements)).count, all_pairs(&vertices, &elements).len());
    }
}

#[test]
fn a_clean_surface_has_no_crossings_and_two_boxes_through_each_other_have_some() {
    let mesh = box_mesh([1.0, 2.0, 1.0], 4, Pattern::Alternating).unwrap();
    let mut surface = SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh));
    assert_eq!(self_intersections(&surface), SelfIntersections::default());
    let count = surface.vertices.len();
    surface.vertices.extend(mesh.vertices.iter().map(|x| x + Vector3::repeat(0.3)));
    let moved: Vec<_> = surface.elements.iter().map(|element| element.map(|i| i + count)).collect();
    surface.elements.extend(moved);
    let found = self_intersections(&surface);
    assert!(found.count > 20 && found.first.is_some_and(|[i, j]| i < j), "{found:?}");
}

#[test]
fn folds_copies_and_touching_triangles_count_and_separate_neighbours_do_not() {
    let square = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 0], [1, 1, 1], [1, 1, 2]];
    let count = |elements: &[[usize; 3]]| self_intersections(&surface(&square, elements)).count;
    assert_eq!(count(&[[0, 1, 2], [0, 2, 3]]), 0, "neighbours in one plane");
    assert_eq!(count(&[[0, 1, 2], [0, 1, 3]]), 1, "a fold");
    assert_eq!(count(&[[0, 1, 2], [2, 1, 0]]), 1, "a copy that looks the other way");
    assert_eq!(count(&[[0, 1, 3], [4, 5, 2]]), 1, "a corner on an edge");
    assert_eq!(count(&[[0, 1, 2], [0, 5, 6]]), 0, "a common corner alone");
    assert_eq!(count(&[[0, 1, 4], [0, 2, 6]]), 1, "beyond a common corner");
}
