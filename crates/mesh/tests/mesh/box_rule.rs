//! The box of a scene file, bit for bit.

use approx::assert_relative_eq;
use fem_mesh::{Pattern, TetrahedralMesh, boundary, box_mesh, check, volumes};
use nalgebra::Vector3;
use std::collections::HashMap;
use std::path::Path;

#[test]
fn one_cell_gives_these_eight_nodes_and_six_tetrahedra() {
    let mesh = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Kuhn).unwrap();
    let nodes = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
        [1.0, 1.0, 1.0],
    ];
    assert_eq!(mesh.vertices, nodes.map(Vector3::from));
    assert_eq!(mesh.elements, [[0, 1, 3, 7], [0, 1, 7, 5], [0, 2, 7, 3], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 7, 6]]);
}

#[test]
fn cells_run_along_x_first_and_coordinates_are_one_division() {
    let mesh = box_mesh([1.0, 2.0 / 3.0, 1.0 / 3.0], 3, Pattern::Kuhn).unwrap();
    assert_eq!(mesh.vertices.len(), 4 * 3 * 2);
    assert_eq!(mesh.elements.len(), 6 * 3 * 2);
    assert_eq!(mesh.vertices[1 + 4 * (2 + 3)], Vector3::new(1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0));
    // the first tetrahedron of the second cell along x, and of the first in the second row
    assert_eq!(mesh.elements[6], [1, 2, 6, 18]);
    assert_eq!(mesh.elements[18], [4, 5, 9, 21]);
}

#[test]
fn every_tetrahedron_of_a_box_is_positive_and_their_volumes_fill_it() {
    let mesh = box_mesh([4.0, 1.0, 0.5], 6, Pattern::Kuhn).unwrap();
    check(&mesh, Path::new("box")).unwrap();
    let volumes = volumes(&mesh);
    assert!(volumes.iter().all(|&volume| volume > 0.0));
    assert_relative_eq!(volumes.iter().sum::<f64>(), 2.0, max_relative = 1e-13);
}

#[test]
fn the_boundary_of_a_box_is_closed_and_looks_outward() {
    let mesh = box_mesh([3.0, 2.0, 1.0], 2, Pattern::Kuhn).unwrap();
    let faces = boundary(&mesh);
    assert_eq!(faces.len(), 2 * 2 * (6 * 4 + 4 * 2 + 6 * 2));
    assert_closed(&faces);
    assert_relative_eq!(enclosed_volume(&mesh, &faces), 6.0, max_relative = 1e-13);
    let centre = Vector3::new(1.5, 1.0, 0.5);
    for face in faces {
        let [a, b, c] = face.map(|i| mesh.vertices[i]);
        assert!((b - a).cross(&(c - a)).dot(&(a - centre)) > 0.0, "{face:?} looks inward");
    }
}

#[test]
fn sizes_that_are_not_whole_cells_are_refused_with_the_axis() {
    let message = box_mesh([1.0, 1.3, 1.0], 2, Pattern::Kuhn).unwrap_err().to_string();
    assert!(message.contains("1.3 m along y times 2 cells") && message.contains("change either"), "{message}");
    for size in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        let message = box_mesh([1.0, 1.0, size], 1, Pattern::Kuhn).unwrap_err().to_string();
        assert!(message.contains("along z"), "{message}");
    }
    assert!(box_mesh([1.0, 1.0, 1.0], 0, Pattern::Kuhn).is_err());
}

#[test]
fn sizes_that_are_whole_but_for_rounding_are_accepted() {
    // 0.1 · 3 and 0.7 · 10 are not whole numbers in binary
    assert_eq!(box_mesh([0.1 + 0.2, 0.7, 0.1], 10, Pattern::Kuhn).unwrap().elements.len(), 6 * 3 * 7);
}

#[test]
fn a_box_of_too_many_elements_is_refused_with_the_figures() {
    let message = box_mesh([4.0, 1.0, 1.0], 1000, Pattern::Kuhn).unwrap_err().to_string();
    assert!(message.contains("4000 × 1000 × 1000") && message.contains("50000000"), "{message}");
    assert!(box_mesh([1e300, 1e300, 1e300], usize::MAX, Pattern::Kuhn).is_err());
    assert!(box_mesh([1.0, 1.0, 1.0], usize::MAX, Pattern::Kuhn).is_err());
}

/// Every edge is passed once in each direction.
pub fn assert_closed(faces: &[[usize; 3]]) {
    let mut passes: HashMap<(usize, usize), usize> = HashMap::new();
    for &[a, b, c] in faces {
        for edge in [(a, b), (b, c), (c, a)] {
            *passes.entry(edge).or_default() += 1;
        }
    }
    for (&(a, b), &count) in &passes {
        assert_eq!((count, passes.get(&(b, a))), (1, Some(&1)), "edge {a} {b}");
    }
}

/// By the divergence theorem: positive for faces that look outward.
pub fn enclosed_volume(mesh: &TetrahedralMesh, faces: &[[usize; 3]]) -> f64 {
    let volume = |face: &[usize; 3]| {
        let [a, b, c] = face.map(|i| mesh.vertices[i]);
        a.cross(&b).dot(&c) / 6.0
    };
    faces.iter().map(volume).sum()
}

#[test]
fn neighbouring_cubes_of_the_alternating_pattern_are_mirror_images() {
    let mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let kuhn = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Kuhn).unwrap();
    let points = |mesh: &TetrahedralMesh, elements: &[[usize; 4]], mirrored: bool| {
        let place = |i: usize| mesh.vertices[i].map(|x| x as usize);
        let mirror = |x: Vector3<usize>| if mirrored { Vector3::new(2 - x.x, x.y, x.z) } else { x };
        let mut found: Vec<_> =
            elements.iter().map(|e| sorted(e.map(|i| <[usize; 3]>::from(mirror(place(i)))))).collect();
        found.sort_unstable();
        found
    };
    assert_eq!(points(&mesh, &mesh.elements[..6], false), points(&kuhn, &kuhn.elements, false));
    assert_eq!(points(&mesh, &mesh.elements[6..], true), points(&kuhn, &kuhn.elements, false));
}

#[test]
fn an_even_number_of_cubes_makes_a_box_symmetric_under_its_mirror_planes() {
    let size = [4, 2, 3];
    let mesh = box_mesh(size.map(|edge| edge as f64), 1, Pattern::Alternating).unwrap();
    let elements = |mirror: Option<usize>| {
        let place = |i: usize| -> [usize; 3] {
            let x = mesh.vertices[i].map(|x| x as usize);
            std::array::from_fn(|d| if mirror == Some(d) { size[d] - x[d] } else { x[d] })
        };
        let mut found: Vec<_> = mesh.elements.iter().map(|e| sorted(e.map(place))).collect();
        found.sort_unstable();
        found
    };
    assert_eq!([0, 1, 2].map(|d| elements(Some(d)) == elements(None)), [true, true, false], "three cubes across z");
}

#[test]
fn boxes_of_both_patterns_are_conforming_and_full_also_with_odd_numbers_of_cubes() {
    for pattern in [Pattern::Alternating, Pattern::Kuhn] {
        let mesh = box_mesh([2.5, 1.5, 1.0], 2, pattern).unwrap();
        check(&mesh, Path::new("box")).unwrap();
        let volumes = volumes(&mesh);
        volumes.iter().for_each(|&volume| assert_relative_eq!(volume, 1.0 / 48.0, max_relative = 1e-13));
        assert_relative_eq!(volumes.iter().sum::<f64>(), 3.75, max_relative = 1e-13);
        let mut shares: HashMap<[usize; 3], usize> = HashMap::new();
        for [a, b, c, d] in mesh.elements.iter().copied() {
            for face in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
                *shares.entry(sorted(face)).or_default() += 1;
            }
        }
        let of = |count: usize| shares.values().filter(|&&share| share == count).count();
        let outside = 2 * 2 * (5 * 3 + 5 * 2 + 3 * 2);
        assert_eq!((of(1), of(2)), (outside, (4 * mesh.elements.len() - outside) / 2), "{pattern:?}");
    }
}

fn sorted<T: Ord, const N: usize>(mut items: [T; N]) -> [T; N] {
    items.sort_unstable();
    items
}
