//! Delaunay meshes of random and degenerate points, tested against the definition by determinants in integers.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use fem_mesh::generate::delaunay::{Delaunay, DelaunayError, insertion_order, tetrahedralize, triangulate};
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use crate::fixed_seed;

pub type Point = [i64; 3];

/// Determinant of the columns b − a, c − a, d − a: six times the signed volume.
pub fn volume(a: Point, b: Point, c: Point, d: Point) -> i128 {
    let from_a = |x: Point| std::array::from_fn::<i128, 3, _>(|i| i128::from(x[i] - a[i]));
    let [u, v, w] = [b, c, d].map(from_a);
    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0])
}

/// A quick hash of indices: a multiplication for each, by the constant of Knuth, The Art of Computer Programming 3 (1998), section 6.4.
#[derive(Clone, Copy, Default)]
pub struct Mixer(u64);

pub type Mixing = BuildHasherDefault<Mixer>;

impl Hasher for Mixer {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(4) {
            let word = chunk.iter().fold(0, |word, &byte| word << 8 | u64::from(byte));
            self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        }
    }

    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }
}

/// Positive if e lies inside the sphere through the positively oriented a, b, c, d.
fn in_sphere([a, b, c, d]: [Point; 4], e: Point) -> i128 {
    let square = |x: Point| (0..3).map(|i| i128::from(x[i] - e[i]).pow(2)).sum::<i128>();
    square(a) * volume(e, b, c, d) - square(b) * volume(e, a, c, d) + square(c) * volume(e, a, b, d)
        - square(d) * volume(e, a, b, c)
}

/// Panics unless the elements are a Delaunay tetrahedralization of the points: positively oriented, each face shared by two of them or on
/// the convex hull, no vertex beyond a face in the sphere of a tetrahedron, the hull's faces convex along each edge, all points used.
/// Delaunay's lemma makes a mesh with these local properties globally Delaunay.
fn is_delaunay(points: &[Point]) {
    let coordinates: Vec<Vector3<f64>> = points.iter().map(|x| Vector3::from(x.map(|x| x as f64))).collect();
    assert_delaunay(points, &tetrahedralize(&coordinates, &|_| ()).unwrap());
}

/// [`is_delaunay`] of a mesh that is known.
pub fn assert_delaunay(points: &[Point], found: &Delaunay<3, 4>) {
    let at = |vertex: usize| -> Point { std::array::from_fn(|i| found.mesh.vertices[vertex][i] as i64) };
    for (point, &vertex) in points.iter().zip(&found.vertices) {
        assert_eq!(at(vertex), *point);
    }
    let mut used = vec![false; found.mesh.vertices.len()];
    let mut faces: HashMap<[u32; 3], ([usize; 4], usize), Mixing> = HashMap::default();
    let mut six_volumes = 0;
    for &element in &found.mesh.elements {
        let [a, b, c, d] = element.map(at);
        let volume = volume(a, b, c, d);
        assert!(volume > 0, "{element:?} of {points:?}");
        six_volumes += volume;
        for i in 0..4 {
            used[element[i]] = true;
            let mut face = [0, 1, 2].map(|k| element[(i + 1 + k) % 4] as u32);
            face.sort_unstable();
            match faces.remove(&face) {
                None => drop(faces.insert(face, (element, i))),
                Some((other, j)) => {
                    let (beyond, here) = (at(other[j]), element.map(at));
                    assert!(in_sphere(here, beyond) <= 0, "{element:?} and {other:?} of {points:?}");
                }
            }
        }
    }
    assert!(used.iter().all(|used| *used), "{points:?}");
    is_convex(faces.values(), at);
    // The hull encloses the volume of all tetrahedra once.
    let origin = at(0);
    let enclosed: i128 = faces.values().map(|(element, i)| with(element.map(at), *i, origin)).sum();
    assert_eq!(enclosed, six_volumes, "{points:?}");
}

/// Six times the volume between the face opposite corner i and a point; positive on the side of that corner.
fn with(mut element: [Point; 4], i: usize, point: Point) -> i128 {
    element[i] = point;
    let [a, b, c, d] = element;
    volume(a, b, c, d)
}

/// Neighbouring faces of the hull have each other's vertices inside or on their planes.
fn is_convex<'a>(faces: impl Iterator<Item = &'a ([usize; 4], usize)>, at: impl Fn(usize) -> Point + Copy) {
    let mut edges: HashMap<[usize; 2], Vec<([usize; 4], usize)>> = HashMap::new();
    for &(element, i) in faces {
        let corners: Vec<usize> = (0..4).filter(|&k| k != i).map(|k| element[k]).collect();
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            edges.entry([a.min(b), a.max(b)]).or_default().push((element, i));
        }
    }
    for (edge, beside) in &edges {
        assert_eq!(beside.len(), 2, "the edge {edge:?} of the hull");
        for ((element, i), (other, j)) in [(beside[0], beside[1]), (beside[1], beside[0])] {
            for k in (0..4).filter(|&k| k != j) {
                assert!(with(element.map(at), i, at(other[k])) >= 0, "{element:?} and {other:?}");
            }
        }
    }
}

fn is_in_space(points: &[Point]) -> bool {
    let coordinates: Vec<Vector3<f64>> = points.iter().map(|x| Vector3::from(x.map(|x| x as f64))).collect();
    tetrahedralize(&coordinates, &|_| ()).is_ok()
}

/// Number of cases of a property test; `DELAUNAY_CASES` sets another.
fn cases(usual: u32) -> u32 {
    std::env::var("DELAUNAY_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

fn hold(cases: u32, points: impl Strategy<Value = Vec<Point>>) {
    let mut runner = TestRunner::new(fixed_seed(cases));
    let done = runner.run(&points, |points| {
        if is_in_space(&points) {
            is_delaunay(&points);
        }
        Ok(())
    });
    done.unwrap_or_else(|failure| panic!("{failure}"));
}

fn coordinate(size: i64) -> impl Strategy<Value = Point> {
    [-size..=size, -size..=size, -size..=size]
}

#[test]
fn random_points_have_a_delaunay_tetrahedralization() {
    hold(cases(200), prop::collection::vec(coordinate(1 << 20), 4..120));
}

#[test]
fn points_of_a_small_grid_with_many_repetitions_ties_and_planes_have_one() {
    hold(cases(400), prop::collection::vec(coordinate(2), 4..80));
    hold(cases(200), prop::collection::vec([-1..=1_i64, -3..=3, 0..=1], 4..60));
}

#[test]
fn whole_grids_spheres_lines_and_planes_have_one() {
    let grid = |n: i64| (0..n.pow(3)).map(|i| [i % n, i / n % n, i / (n * n)]).collect::<Vec<Point>>();
    for n in 2..7 {
        is_delaunay(&grid(n));
    }
    // All integer points at the distance √1105 from the origin: cospherical without any round-off.
    let sphere: Vec<Point> = grid(67)
        .into_iter()
        .map(|x| x.map(|x| x - 33))
        .filter(|x| x.iter().map(|x| x * x).sum::<i64>() == 1105)
        .collect();
    assert!(sphere.len() > 100, "{}", sphere.len());
    is_delaunay(&sphere);
    let with_centre = [&sphere[..], &[[0; 3]]].concat();
    is_delaunay(&with_centre);
    let line_and_point: Vec<Point> =
        (0..50).map(|i| [i, 2 * i, -i]).chain([[0, 0, 50], [3, 0, 7], [3, 0, 7]]).collect();
    is_delaunay(&line_and_point);
    let plane_and_apex: Vec<Point> = (0..100).map(|i| [i % 10, i / 10, 0]).chain([[4, 4, 1]]).collect();
    is_delaunay(&plane_and_apex);
    // Two skew lines: n² tetrahedra.
    let skew: Vec<Point> = (0..20).flat_map(|i| [[i, 0, 0], [0, i - 10, 100]]).collect();
    is_delaunay(&skew);
}

#[test]
fn tiny_perturbations_of_a_grid_do_not_break_it() {
    let grid: Vec<Point> = (0..125).map(|i| [i % 5, i / 5 % 5, i / 25]).collect();
    let moved = |seed: i64| {
        let grid = grid.iter().enumerate();
        grid.map(|(i, x)| x.map(|x| (x << 38) + (seed.wrapping_mul(7919) ^ (i as i64 * 104_729)) % 3 - 1)).collect()
    };
    for seed in 1..20 {
        // Coordinates of 41 bits: determinants of the fifth degree have more digits than i128, so count volumes only.
        let points: Vec<Point> = moved(seed);
        let coordinates: Vec<Vector3<f64>> = points.iter().map(|x| Vector3::from(x.map(|x| x as f64))).collect();
        let found = tetrahedralize(&coordinates, &|_| ()).unwrap();
        let six_volumes = found.mesh.elements.iter().map(|element| {
            let [a, b, c, d] = element.map(|i| std::array::from_fn(|k| found.mesh.vertices[i][k] as i64));
            let volume = volume(a, b, c, d);
            assert!(volume > 0);
            volume
        });
        let cube = 6 * (4_i128 << 38).pow(3);
        assert!((six_volumes.sum::<i128>() - cube).abs() < cube >> 34);
    }
}

#[test]
fn points_at_one_place_share_the_vertex_of_the_first() {
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3], [-0.0, 0.0, 1.0]];
    let found = tetrahedralize(&corner.map(Vector3::from), &|_| ()).unwrap();
    assert_eq!(found.vertices, [0, 1, 2, 3, 0, 3]);
    assert_eq!(found.mesh.elements.len(), 1);
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-0.0, 0.0]];
    let found = triangulate(&square.map(Vector2::from)).unwrap();
    assert_eq!(found.vertices, [0, 1, 1, 2, 3, 0]);
    assert_eq!(found.mesh.elements.len(), 2);
}

#[test]
fn points_without_a_mesh_are_refused() {
    let flat: Vec<Vector3<f64>> = (0..20).map(|i| Vector3::new(f64::from(i % 5), f64::from(i / 5), 7.0)).collect();
    assert_eq!(
        tetrahedralize(&flat, &|_| ()).unwrap_err(),
        DelaunayError::Flat { points: 20, in_what: "in one plane" }
    );
    let same = vec![Vector3::new(1.0, 2.0, 3.0); 9];
    assert_eq!(tetrahedralize(&same, &|_| ()).unwrap_err(), DelaunayError::Flat { points: 9, in_what: "in one plane" });
    assert!(tetrahedralize(&[], &|_| ()).is_err() && triangulate(&[]).is_err());
    let line: Vec<Vector2<f64>> = (0..9).map(|i| Vector2::new(f64::from(i), 0.1 * f64::from(i))).collect();
    let refused = triangulate(&[&line[..], &[Vector2::new(9.0, f64::NAN)]].concat()).unwrap_err();
    assert_eq!(refused, DelaunayError::NotFinite { point: 9 });
    let exactly = (0..9).map(|i| Vector2::new(f64::from(i), 2.0 * f64::from(i))).collect::<Vec<_>>();
    let refused = triangulate(&exactly).unwrap_err().to_string();
    assert_eq!(refused, "all 9 points lie on one line; add a point outside of it");
    for bad in [f64::INFINITY, f64::NAN, 1e100] {
        let mut points = flat.clone();
        points[3].z = bad;
        assert_eq!(tetrahedralize(&points, &|_| ()).unwrap_err(), DelaunayError::NotFinite { point: 3 });
    }
    let tiny = [[0.0; 3], [1e-300, 0.0, 0.0], [0.0, 1e-300, 0.0], [0.0, 0.0, 1e-300]];
    assert!(tetrahedralize(&tiny.map(Vector3::from), &|_| ()).is_err());
}

#[test]
fn triangles_are_delaunay_and_fill_the_hull() {
    let mut runner = TestRunner::new(fixed_seed(cases(200)));
    let points = prop::collection::vec([-40..=40_i64, -40..=40], 3..200);
    let done = runner.run(&points, |points| {
        let coordinates: Vec<Vector2<f64>> = points.iter().map(|x| Vector2::from(x.map(|x| x as f64))).collect();
        let Ok(found) = triangulate(&coordinates) else { return Ok(()) };
        let at = |vertex: usize| [0, 1].map(|i| found.mesh.vertices[vertex][i] as i64);
        for element in &found.mesh.elements {
            let [a, b, c] = element.map(at);
            let lifted = |x: [i64; 2]| [x[0], x[1], x[0] * x[0] + x[1] * x[1]];
            let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            prop_assert!(twice_area > 0);
            for &d in &points {
                // A point in the circle lies below the plane through the lifted corners.
                prop_assert!(volume(lifted(a), lifted(b), lifted(c), lifted(d)) >= 0, "{:?} {:?}", element, d);
            }
        }
        Ok(())
    });
    done.unwrap_or_else(|failure| panic!("{failure}"));
}

/// Indices of so many points of one place in the order of insertion, round by round.
fn rounds(points: usize) -> Vec<Vec<usize>> {
    let order = insertion_order(&vec![Vector3::zeros(); points]);
    order.chunk_by(|a, b| a < b).map(<[usize]>::to_vec).collect()
}

#[test]
fn neighbours_on_the_curve_are_neighbours_in_space() {
    // The points of a cubic grid are in the last round, in the parts of space that the curve goes through first of all.
    let last = rounds(2048).pop().unwrap();
    let mut points = vec![Vector3::zeros(); 2048];
    let cells = (0..512).map(|cell| [cell & 7, cell >> 3 & 7, cell >> 6].map(|x: u32| x));
    last.iter().zip(cells).for_each(|(&index, cell)| points[index] = Vector3::from(cell.map(f64::from)));
    let mut order = insertion_order(&points);
    order.retain(|index| last[..512].contains(index));
    assert_eq!(order.len(), 512);
    for pair in order.windows(2) {
        let distance = (points[pair[0]] - points[pair[1]]).abs().sum();
        assert_eq!(distance, 1.0, "{} and {}", points[pair[0]], points[pair[1]]);
    }
}

#[test]
fn every_round_has_about_twice_the_points_of_the_one_before() {
    let last = rounds(4096).pop().unwrap().len();
    assert!((1900..2200).contains(&last), "{last}");
    let mut order = rounds(100).concat();
    order.sort_unstable();
    assert_eq!(order, (0..100).collect::<Vec<_>>());
}
