//! The box of a scene file, bit for bit.

use approx::assert_relative_eq;
use fem_mesh::{TetrahedralMesh, boundary, box_mesh, check, volumes};
use nalgebra::Vector3;
use std::collections::HashMap;
use std::path::Path;

#[test]
fn one_cell_gives_these_eight_nodes_and_six_tetrahedra() {
    let mesh = box_mesh([1.0, 1.0, 1.0], 1).unwrap();
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
    let mesh = box_mesh([1.0, 2.0 / 3.0, 1.0 / 3.0], 3).unwrap();
    assert_eq!(mesh.vertices.len(), 4 * 3 * 2);
    assert_eq!(mesh.elements.len(), 6 * 3 * 2);
    assert_eq!(mesh.vertices[1 + 4 * (2 + 3)], Vector3::new(1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0));
    // the first tetrahedron of the second cell along x, and of the first in the second row
    assert_eq!(mesh.elements[6], [1, 2, 6, 18]);
    assert_eq!(mesh.elements[18], [4, 5, 9, 21]);
}

#[test]
fn every_tetrahedron_of_a_box_is_positive_and_their_volumes_fill_it() {
    let mesh = box_mesh([4.0, 1.0, 0.5], 6).unwrap();
    check(&mesh, Path::new("box")).unwrap();
    let volumes = volumes(&mesh);
    assert!(volumes.iter().all(|&volume| volume > 0.0));
    assert_relative_eq!(volumes.iter().sum::<f64>(), 2.0, max_relative = 1e-13);
}

#[test]
fn the_boundary_of_a_box_is_closed_and_looks_outward() {
    let mesh = box_mesh([3.0, 2.0, 1.0], 2).unwrap();
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
    let message = box_mesh([1.0, 1.3, 1.0], 2).unwrap_err().to_string();
    assert!(message.contains("1.3 m along y times 2 cells") && message.contains("change either"), "{message}");
    for size in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        let message = box_mesh([1.0, 1.0, size], 1).unwrap_err().to_string();
        assert!(message.contains("along z"), "{message}");
    }
    assert!(box_mesh([1.0, 1.0, 1.0], 0).is_err());
}

#[test]
fn sizes_that_are_whole_but_for_rounding_are_accepted() {
    // 0.1 · 3 and 0.7 · 10 are not whole numbers in binary
    assert_eq!(box_mesh([0.1 + 0.2, 0.7, 0.1], 10).unwrap().elements.len(), 6 * 3 * 7);
}

#[test]
fn a_box_of_too_many_elements_is_refused_with_the_figures() {
    let message = box_mesh([4.0, 1.0, 1.0], 1000).unwrap_err().to_string();
    assert!(message.contains("4000 × 1000 × 1000") && message.contains("50000000"), "{message}");
    assert!(box_mesh([1e300, 1e300, 1e300], usize::MAX).is_err());
    assert!(box_mesh([1.0, 1.0, 1.0], usize::MAX).is_err());
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
