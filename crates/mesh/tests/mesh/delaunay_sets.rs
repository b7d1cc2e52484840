//! Many point sets of 3 to 10⁴ points, random and degenerate, tested against the definition by determinants in integers.
//!
//! `DELAUNAY_CASES=100000 cargo test --release -p fem-mesh --test mesh delaunay_sets` runs as many random sets and a tenth as many
//! degenerate ones, in space and in the plane; `DELAUNAY_FROM` begins with a later one.

use std::collections::HashMap;
use std::ops::Range;

use fem_mesh::generate::delaunay::{Delaunay, tetrahedralize, triangulate};
use nalgebra::{Vector2, Vector3};

use crate::delaunay::{Point, assert_delaunay, volume};

/// Largest number of points of a set.
const MOST: f64 = 1e4;

/// The same numbers in every run: SplitMix64 by Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators (2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// An integer from `-size` to `size`.
    fn within(&mut self, size: i64) -> i64 {
        (self.next() % (2 * size as u64 + 1)) as i64 - size
    }

    fn point(&mut self, size: i64) -> Point {
        [self.within(size), self.within(size), self.within(size)]
    }

    /// Number of points of a set: of every order of magnitude, small ones more often; in a short run 400 at most.
    fn count(&mut self, is_long: bool) -> usize {
        let most = if is_long { MOST } else { 400.0 };
        let part = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        (3.0 * (most / 3.0).powf(part.powi(3))).round() as usize
    }
}

/// Which sets to test, and whether they may be large: those that `DELAUNAY_CASES` and `DELAUNAY_FROM` ask for, both divided, or the
/// first few.
fn cases(part: u64) -> (Range<u64>, bool) {
    let number = |name| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let from = number("DELAUNAY_FROM").unwrap_or(0) / part;
    match number("DELAUNAY_CASES") {
        Some(cases) => (from..from + cases.div_ceil(part), true),
        None => (0..150, false),
    }
}

/// Points without a pattern: in a cube, in clusters, near a sphere, in a flat or a long box, on a curve.
fn random_set(random: &mut Random, count: usize) -> Vec<Point> {
    const SIZE: i64 = 1 << 20;
    // n points on a curve may have n² tetrahedra.
    let kind = if count > 300 { random.next() % 5 } else { random.next() % 6 };
    let centres: Vec<Point> = (0..5).map(|_| random.point(SIZE / 2)).collect();
    let point = |_| {
        let [x, y, z] = random.point(SIZE);
        match kind {
            0 | 1 => [x, y, z],
            2 => {
                let centre = centres[random.next() as usize % centres.len()];
                [0, 1, 2].map(|i| centre[i] + [x, y, z][i] / 4096)
            }
            3 => {
                let length = ((x * x + y * y + z * z) as f64).sqrt().max(1.0);
                [x, y, z].map(|x| (x as f64 / length * 1e6) as i64)
            }
            4 => [x, y / 16, z / 65_536],
            _ => [x, x * x / SIZE, (x as f64 / 1e5).sin().mul_add(1e5, 0.0) as i64 + z / 262_144],
        }
    };
    (0..count).map(point).collect()
}

/// Points with ties, repetitions, lines and planes: a small cube of integers, a whole grid, integers on one sphere, layers, two lines, a
/// prism, a grid with a point in each cell.
fn degenerate_set(random: &mut Random, count: usize) -> Vec<Point> {
    let (kind, side) = (random.next() % 7, (count as f64).cbrt().ceil() as i64);
    let i_of = |i: usize| i as i64;
    let cell = |i: usize| [i_of(i) % side, i_of(i) / side % side, i_of(i) / (side * side)];
    let radius = sphere();
    let point = |i: usize| match kind {
        0 => random.point(2 + side / 4),
        1 => cell(i),
        2 => radius[random.next() as usize % radius.len()],
        3 => [random.within(side), random.within(side), random.within(1)],
        4 if i.is_multiple_of(2) => [i_of(i) / 2, 0, 0],
        4 => [0, i_of(i) / 2 % 64, 64],
        5 => {
            let [x, y, _] = radius[random.next() as usize % radius.len()];
            [x, y, random.within(3)]
        }
        _ => cell(i / 2).map(|x| 2 * x + i_of(i) % 2),
    };
    (0..count).map(point).collect()
}

/// All integer points at the distance √1105 from the origin.
fn sphere() -> Vec<Point> {
    let range = -33..=33_i64;
    let pairs = range.clone().flat_map(|x| range.clone().map(move |y| [x, y]));
    let heights = |[x, y]: [i64; 2]| {
        let z = ((1105 - x * x - y * y).max(0) as f64).sqrt().round() as i64;
        [[x, y, z], [x, y, -z]].into_iter().filter(|x| x.iter().map(|x| x * x).sum::<i64>() == 1105)
    };
    pairs.flat_map(heights).collect()
}

/// Returns true if no four of the points span a volume.
fn is_flat(points: &[Point]) -> bool {
    let Some(&a) = points.first() else { return true };
    let Some(&b) = points.iter().find(|&&b| b != a) else { return true };
    let is_on_line = |c: Point| [[1, 0, 0], [0, 1, 0], [0, 0, 1]].iter().all(|e| volume(a, b, c, plus(a, *e)) == 0);
    let Some(&c) = points.iter().find(|&&c| !is_on_line(c)) else { return true };
    points.iter().all(|&d| volume(a, b, c, d) == 0)
}

fn plus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] + b[i])
}

fn hold_in_space((cases, is_long): (Range<u64>, bool), seed: u64, set: fn(&mut Random, usize) -> Vec<Point>) {
    for case in cases {
        let mut random = Random(seed + case);
        let count = random.count(is_long);
        let points = set(&mut random, count);
        let coordinates: Vec<Vector3<f64>> = points.iter().map(|x| Vector3::from(x.map(|x| x as f64))).collect();
        let checked = std::panic::catch_unwind(|| match tetrahedralize(&coordinates, &|_| ()) {
            Ok(found) => assert_delaunay(&points, &found),
            Err(error) => assert!(is_flat(&points), "{error}"),
        });
        assert!(checked.is_ok(), "the set of seed {} with {count} points", seed + case);
    }
}

fn hold_in_plane((cases, is_long): (Range<u64>, bool), seed: u64, set: fn(&mut Random, usize) -> Vec<Point>) {
    for case in cases {
        let mut random = Random(seed + case);
        let count = random.count(is_long);
        let points: Vec<[i64; 2]> = set(&mut random, count).into_iter().map(|[x, y, _]| [x, y]).collect();
        let coordinates: Vec<Vector2<f64>> = points.iter().map(|x| Vector2::from(x.map(|x| x as f64))).collect();
        let checked = std::panic::catch_unwind(|| match triangulate(&coordinates) {
            Ok(found) => assert_delaunay_in_plane(&points, &found),
            Err(error) => assert!(is_straight(&points), "{error}"),
        });
        assert!(checked.is_ok(), "the set of seed {} with {count} points", seed + case);
    }
}

/// Twice the signed area.
fn area(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i128 {
    let [u, v] = [b, c].map(|x| [0, 1].map(|i| i128::from(x[i] - a[i])));
    u[0] * v[1] - u[1] * v[0]
}

fn is_straight(points: &[[i64; 2]]) -> bool {
    let Some(&a) = points.first() else { return true };
    let Some(&b) = points.iter().find(|&&b| b != a) else { return true };
    points.iter().all(|&c| area(a, b, c) == 0)
}

/// Panics unless the triangles are positively oriented, share each edge with one other that has no corner in their circle or with the
/// convex hull, fill the hull once and use all points. Delaunay's lemma makes such a mesh globally Delaunay.
fn assert_delaunay_in_plane(points: &[[i64; 2]], found: &Delaunay<2, 3>) {
    let at = |vertex: usize| [0, 1].map(|i| found.mesh.vertices[vertex][i] as i64);
    assert!(points.iter().zip(&found.vertices).all(|(point, &vertex)| at(vertex) == *point));
    let lifted = |[x, y]: [i64; 2]| [x, y, x * x + y * y];
    let mut used = vec![false; found.mesh.vertices.len()];
    let mut edges: HashMap<[usize; 2], ([usize; 3], usize)> = HashMap::new();
    let mut twice_area = 0;
    for &element in &found.mesh.elements {
        let [a, b, c] = element.map(at);
        assert!(area(a, b, c) > 0, "{element:?}");
        twice_area += area(a, b, c);
        for i in 0..3 {
            used[element[i]] = true;
            let [from, to] = [element[(i + 1) % 3], element[(i + 2) % 3]];
            match edges.remove(&[from.min(to), from.max(to)]) {
                None => drop(edges.insert([from.min(to), from.max(to)], (element, i))),
                // A point in the circle lies below the plane through the lifted corners.
                Some((other, j)) => {
                    let beyond = at(other[j]);
                    assert!(volume(lifted(a), lifted(b), lifted(c), lifted(beyond)) >= 0, "{element:?} {other:?}");
                }
            }
        }
    }
    assert!(used.iter().all(|used| *used));
    let hull: HashMap<usize, usize> =
        edges.values().map(|(element, i)| (element[(i + 1) % 3], element[(i + 2) % 3])).collect();
    assert_eq!(hull.len(), edges.len(), "a vertex of the hull has two edges that leave it");
    let around: i128 = hull.iter().map(|(&from, &to)| area(at(0), at(from), at(to))).sum();
    assert_eq!(around, twice_area);
    assert!(hull.iter().all(|(&from, to)| area(at(from), at(*to), at(hull[to])) >= 0), "the hull is not convex");
}

#[test]
fn random_points_in_space_have_delaunay_tetrahedra() {
    hold_in_space(cases(1), 1 << 40, random_set);
}

#[test]
fn degenerate_points_in_space_have_delaunay_tetrahedra() {
    hold_in_space(cases(10), 2 << 40, degenerate_set);
}

#[test]
fn random_points_in_the_plane_have_delaunay_triangles() {
    hold_in_plane(cases(1), 3 << 40, random_set);
}

#[test]
fn degenerate_points_in_the_plane_have_delaunay_triangles() {
    hold_in_plane(cases(10), 4 << 40, degenerate_set);
}
