//! Tetrahedra in bodies of chance, which reach every case of the lattice and of its stencils.

use std::cell::Cell;

use fem_mesh::generate::{Implicit, stuff_implicit};
use fem_mesh::{Mesh, SurfaceMesh, boundary, check, quality, surface_quality};
use nalgebra::Vector3;

/// Mean edge of a lattice whose cubes have sides of 1 m; their corners are at whole numbers.
const EDGE: f64 = 0.910_683_602_522_959;

fn random(seed: u64) -> impl Fn() -> f64 {
    let random = Cell::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    move || {
        let mut x = random.get();
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        random.set(x);
        (x >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The mesh of a body with random signs of a lattice's nodes and random cuts of its edges.
fn by_chance(seed: u64, inside: f64, cubes: f64) -> Mesh<3, 4> {
    let next = random(seed);
    let in_box = |x: &Vector3<f64>| x.iter().all(|x| (0.0..=cubes).contains(x));
    let body = Implicit { is_inside: &|x| in_box(x) && next() < inside, exit: &|_, _| next() };
    stuff_implicit(&body, [Vector3::zeros(), Vector3::repeat(cubes)], EDGE, 0).unwrap()
}

/// The mesh of a graded lattice around a box with random holes and a ragged surface, and that of the uniform one.
fn graded_and_uniform(seed: u64) -> [Mesh<3, 4>; 2] {
    let size = Vector3::new(33.0, 27.0, 20.0);
    [3, 0].map(|doublings| {
        let next = random(seed);
        let holes: Vec<Vector3<f64>> = (0..3).map(|_| Vector3::from_fn(|_, _| (33.0 * next()).round())).collect();
        let is_inside = |x: &Vector3<f64>| {
            let depth = (0..3).map(|i| x[i].min(size[i] - x[i])).fold(f64::INFINITY, f64::min);
            let in_hole = holes.iter().any(|hole| (hole - x).norm() < 2.5);
            depth > 0.0 && !in_hole && (depth > 1.5 || next() < 0.6)
        };
        let body = Implicit { is_inside: &is_inside, exit: &|_, _| next() };
        stuff_implicit(&body, [Vector3::zeros(), size], EDGE, doublings).unwrap()
    })
}

#[test]
fn a_graded_lattice_keeps_the_bounds_and_the_boundary_of_the_uniform_one() {
    for seed in 1..=4 {
        let [graded, uniform] = graded_and_uniform(seed);
        check(&graded, "graded".as_ref()).unwrap();
        let angles = quality(&graded).dihedral_angles.map(|angle| angle.value);
        assert!(angles[0] >= 10.7 && angles[1] <= 164.8, "seed {seed}: {angles:?}");
        let surface = |mesh: &Mesh<3, 4>| {
            let place = |face: [usize; 3]| {
                let mut places = face.map(|i| mesh.vertices[i].map(f64::to_bits).into());
                places.sort_unstable();
                places
            };
            let mut faces: Vec<[[u64; 3]; 3]> = boundary(mesh).into_iter().map(place).collect();
            faces.sort_unstable();
            faces
        };
        assert!(surface(&graded) == surface(&uniform), "seed {seed}");
        assert!(10 * graded.elements.len() < 9 * uniform.elements.len(), "seed {seed}: {}", graded.elements.len());
    }
}

#[test]
fn tetrahedra_between_cubes_of_different_sizes_have_angles_from_45_to_120_degrees() {
    let body = Implicit { is_inside: &|x| x.iter().all(|x| (0.5..29.5).contains(x)), exit: &|_, _| 0.5 };
    let mut mesh = stuff_implicit(&body, [Vector3::zeros(), Vector3::repeat(30.0)], EDGE, 3).unwrap();
    // Away from the surface no node has moved.
    let vertices = &mesh.vertices;
    mesh.elements.retain(|element| element.iter().flat_map(|&i| &vertices[i]).all(|x| (3.0..27.0).contains(x)));
    let angles = quality(&mesh).dihedral_angles.map(|angle| angle.value);
    assert!((angles[0] - 45.0).abs() < 1e-9 && (angles[1] - 120.0).abs() < 1e-9, "{angles:?}");
}

#[test]
fn dihedral_angles_keep_their_bounds_for_any_signs_and_cuts() {
    let mut range = [f64::INFINITY, 0.0_f64];
    for seed in 1..40 {
        let mesh = by_chance(seed, [0.35, 0.5, 0.8][seed as usize % 3], 8.0);
        check(&mesh, "chance".as_ref()).unwrap();
        let angles = quality(&mesh).dihedral_angles.map(|angle| angle.value);
        range = [range[0].min(angles[0]), range[1].max(angles[1])];
    }
    assert!(range[0] >= 10.7 && range[1] <= 164.8, "{range:?}");
}

#[test]
fn neighbouring_tetrahedra_share_whole_faces_so_that_the_boundary_has_no_open_edge() {
    for seed in 1..10 {
        let mesh = by_chance(seed, 0.5, 6.0);
        let surface = SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh));
        let found = surface_quality(&surface);
        assert_eq!((found.open_edges, found.flipped_edges), (0, 0));
    }
}

#[test]
fn a_box_without_an_inside_is_refused_and_parts_of_a_way_that_are_none_are_those_nearest() {
    let outside = |part: f64, corners: [f64; 2]| {
        let body = Implicit { is_inside: &|x| x.norm() < 2.5, exit: &|_, _| part };
        stuff_implicit(&body, corners.map(Vector3::repeat), EDGE, 0)
    };
    for (given, part) in [(f64::NAN, 0.0), (-1.0, 0.0), (f64::NEG_INFINITY, 0.0), (7.0, 1.0), (f64::INFINITY, 1.0)] {
        let mesh = outside(given, [-3.0, 3.0]).unwrap();
        check(&mesh, "taken as another".as_ref()).unwrap();
        assert_eq!(mesh, outside(part, [-3.0, 3.0]).unwrap(), "{given}");
    }
    for corners in [[3.0, -3.0], [f64::NAN, 3.0], [-3.0, f64::NAN], [f64::NEG_INFINITY, f64::INFINITY]] {
        assert!(outside(0.5, corners).is_err(), "{corners:?}");
    }
    assert!(outside(0.5, [5.0, 9.0]).is_err());
}
